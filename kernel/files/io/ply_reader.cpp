// PLY: a text header declares elements (vertex, face, others) with scalar and list properties, then come the elements
// one after the other, as text or as binary numbers in either byte order.
//
// The body is read through a source of numbers, one per encoding, so that there is one way through the elements.
// Element counts are only believed as far as the file goes: every item of an element consumes bytes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "files/io/inside/binary_scanner.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    Scalar type = Scalar::float32;  // of the value, or of the items of a list
    bool is_list = false;
    Scalar count_type = Scalar::uint8;  // of a list
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
};

Scalar to_scalar_type(std::string_view word, const TextScanner& scanner) {
    constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (word == names[i][0] || word == names[i][1]) return static_cast<Scalar>(i);
    scanner.fail("the type \"" + std::string(word.substr(0, 40)) + "\" is unknown. Export the surface again.");
}

Encoding read_encoding(TextScanner& scanner) {
    const std::string_view word = scanner.next_word();
    if (word == "ascii") return Encoding::ascii;
    if (word == "binary_little_endian") return Encoding::little_endian;
    if (word == "binary_big_endian") return Encoding::big_endian;
    scanner.fail("the format \"" + std::string(word.substr(0, 40)) + "\" is unknown. Export the surface again.");
}

Property read_property(TextScanner& scanner) {
    Property property;
    std::string_view word = scanner.next_word();
    property.is_list = word == "list";
    if (property.is_list) {
        property.count_type = to_scalar_type(scanner.next_word(), scanner);
        word = scanner.next_word();
    }
    property.type = to_scalar_type(word, scanner);
    property.name = scanner.next_word();
    return property;
}

Element read_element(TextScanner& scanner) {
    Element element;
    element.name = scanner.next_word();
    element.count = scanner.next_integer();
    if (element.count < 0) scanner.fail("the number of elements is negative. Export the surface again.");
    return element;
}

// Leaves the scanner at the first byte of the body.
Header read_header(TextScanner& scanner) {
    Header header;
    scanner.skip_line();  // "ply"
    for (std::string_view word = scanner.next_word(); word != "end_header"; word = scanner.next_word()) {
        if (word == "format")
            header.encoding = read_encoding(scanner);
        else if (word == "element")
            header.elements.push_back(read_element(scanner));
        else if (word == "property" && !header.elements.empty())
            header.elements.back().properties.push_back(read_property(scanner));
        else if (word != "comment" && word != "obj_info")
            scanner.fail("\"" + std::string(word.substr(0, 40)) +
                         "\" is not expected in the header of a PLY file. Export the surface again.");
        scanner.skip_line();
    }
    scanner.skip_line();
    return header;
}

// Numbers written as text.
class TextSource {
 public:
    /// `scanner` stands behind the header.
    explicit TextSource(const TextScanner& scanner) : scanner_(scanner) {}
    double next(Scalar) { return scanner_.next_real(); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

 private:
    TextScanner scanner_;
};

// Numbers written as their bytes.
class BinarySource {
 public:
    explicit BinarySource(const BinaryScanner& scanner) : scanner_(scanner) {}

    double next(Scalar type) {
        switch (type) {
            case Scalar::int8:
                return scanner_.next<std::int8_t>();
            case Scalar::uint8:
                return scanner_.next<std::uint8_t>();
            case Scalar::int16:
                return scanner_.next<std::int16_t>();
            case Scalar::uint16:
                return scanner_.next<std::uint16_t>();
            case Scalar::int32:
                return scanner_.next<std::int32_t>();
            case Scalar::uint32:
                return scanner_.next<std::uint32_t>();
            case Scalar::float32:
                return scanner_.next<float>();
            case Scalar::float64:
                return scanner_.next<double>();
        }
        return 0;
    }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

 private:
    BinaryScanner scanner_;
};

template <class Source>
std::int64_t next_integer(Source& source, Scalar type) {
    constexpr double exact_limit = 9007199254740992.0;  // 2^53
    const double value = source.next(type);
    if (!(std::abs(value) < exact_limit) || value != std::floor(value))
        source.fail("a whole number is expected. Export the surface again.");
    return static_cast<std::int64_t>(value);
}

template <class Source>
void read_list(Source& source, const Property& property, std::vector<std::int64_t>& items) {
    const std::int64_t size = next_integer(source, property.count_type);
    if (size < 0) source.fail("the size of a list is negative. Export the surface again.");
    items.clear();
    for (std::int64_t i = 0; i < size; ++i) items.push_back(next_integer(source, property.type));
}

template <class Source>
void skip_property(Source& source, const Property& property) {
    const std::int64_t size = property.is_list ? next_integer(source, property.count_type) : 1;
    for (std::int64_t i = 0; i < size; ++i) source.next(property.type);
}

template <class Source>
void read_vertex(Source& source, const Element& element, SoupBuilder& builder) {
    Vec3 p = Vec3::Zero();
    for (const Property& property : element.properties) {
        const bool is_coordinate = property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
        if (is_coordinate && !property.is_list)
            p[property.name[0] - 'x'] = source.next(property.type);
        else
            skip_property(source, property);
    }
    builder.add_vertex(p);
}

// Triangles in strips, each of which ends at a -1: a corner and the two before it, every other one turned. Where two
// are equal the strip only goes on elsewhere.
template <class Fail>
void add_strips(const std::vector<std::int64_t>& corners, SoupBuilder& builder, const Fail& fail) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] == -1) begin = i + 1;
        if (i < begin + 2) continue;
        std::array<std::int64_t, 3> facet = {corners[i - 2], corners[i - 1], corners[i]};
        if ((i - begin) % 2 == 1) std::swap(facet[0], facet[1]);
        if (facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[0]) builder.add_polygon(facet, fail);
    }
}

// A polygon, or strips of triangles.
template <class Source>
void read_face(Source& source, const Element& element, SoupBuilder& builder, std::vector<std::int64_t>& corners) {
    const auto fail = [&](const std::string& what) { source.fail(what); };
    for (const Property& property : element.properties) {
        if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) {
            read_list(source, property, corners);
            element.name == "face" ? builder.add_polygon(corners, fail) : add_strips(corners, builder, fail);
        } else {
            skip_property(source, property);
        }
    }
}

// Requires coordinates: without them a vertex would take no bytes, and all would lie in one point.
void check_coordinates(const TextScanner& scanner, const Header& header) {
    for (const Element& element : header.elements)
        if (element.name == "vertex")
            for (const char* axis : {"x", "y", "z"})
                if (std::none_of(element.properties.begin(), element.properties.end(),
                                 [&](const Property& p) { return p.name == axis && !p.is_list; }))
                    scanner.fail("the vertices have no property " + std::string(axis) + ". Export the surface again.");
}

template <class Source>
Soup read_body(Source source, const Header& header, const std::string& path) {
    SoupBuilder builder(path);
    std::vector<std::int64_t> corners;
    for (const Element& element : header.elements)
        if (element.name == "face") builder.announce_facets(element.count);
    for (const Element& element : header.elements) {
        if (element.properties.empty()) continue;  // takes no bytes, whatever its count claims
        for (std::int64_t i = 0; i < element.count; ++i) {
            if (element.name == "vertex")
                read_vertex(source, element, builder);
            else if (element.name == "face" || element.name == "tristrips")
                read_face(source, element, builder, corners);
            else
                for (const Property& property : element.properties) skip_property(source, property);
        }
    }
    return builder.finish();
}

}  // namespace

Soup read_ply(std::string_view bytes, const std::string& path) {
    TextScanner scanner(bytes, path);
    const Header header = read_header(scanner);
    check_coordinates(scanner, header);
    if (header.encoding == Encoding::ascii) return read_body(TextSource(scanner), header, path);
    const std::endian order = header.encoding == Encoding::big_endian ? std::endian::big : std::endian::little;
    return read_body(BinarySource(BinaryScanner(bytes, scanner.position(), path, order)), header, path);
}

}  // namespace kerf
