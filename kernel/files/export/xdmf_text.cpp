#include "files/export/inside/hdf5_arrays.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/core/xml_text.h"

namespace kerf {

namespace {

class XdmfText {
 public:
    XdmfText(const MeshOutline& outline, std::string h5) : outline_(outline), h5_(std::move(h5)) {}

    std::string text() const {
        std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
        text += information("patch", outline_.patch_names) + information("region", outline_.region_names);
        std::string values;
        for (const PartValues& each : outline_.values)
            values += attribute(array_name(each), each.components, each.of == PartValues::Of::points ? "Node" : "Cell",
                                whole_array_of(each));
        // DOLFINx takes the first attribute for the tags.
        const bool has_regions = !outline_.region_names.empty();
        const std::string regions = has_regions ? attribute("region", 1, "Cell", "viz/region") : "";
        const std::string tags =
            regions + attribute("body", 1, "Cell", "viz/body") + attribute("part", 1, "Cell", "viz/part");
        const int order = outline_.order;
        text += grid("mesh", order == 1 ? "Tetrahedron" : "Tetrahedron_10", nodes_of_tets(order), nodes_array(outline_),
                     tags + values);
        text += grid("facets", order == 1 ? "Triangle" : "Triangle_6", nodes_of_triangles(order), "viz/topology/facets",
                     attribute("patch", 1, "Cell", "viz/patch"));
        return text + "  </Domain>\n</Xdmf>\n";
    }

 private:
    static std::string information(const char* kind, const std::vector<std::string>& names) {
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i)
            text += fmt::format("    <Information Name=\"{} {}\" Value=\"{}\"/>\n", kind, i + 1, xml_text(names[i]));
        return text;
    }

    std::string item(const std::string& name) const {
        const auto array =
            std::find_if(arrays_.begin(), arrays_.end(), [&](const Hdf5Array& each) { return each.name == name; });
        const std::string columns = array->columns ? fmt::format(" {}", array->columns) : "";
        return fmt::format(
            "<DataItem Dimensions=\"{}{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:/{}</DataItem>",
            array->rows, columns, array->type == Hdf5Type::real ? "Float" : "Int", size_of(array->type), xml_text(h5_),
            name);
    }

    std::string attribute(const std::string& name, int components, const char* center, const std::string& array) const {
        const char* type = components == 1 ? "Scalar" : components == 3 ? "Vector" : "Matrix";
        return fmt::format("      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                           xml_text(name), type, center, item(array));
    }

    std::string grid(const char* name, const char* cell, int nodes, const char* cells,
                     const std::string& attributes) const {
        return fmt::format(
            "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
            "      <Topology TopologyType=\"{}\" NodesPerElement=\"{}\">{}</Topology>\n"
            "      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
            "{}    </Grid>\n",
            name, cell, nodes, item(cells), item("geometry/vertices"), attributes);
    }

    const MeshOutline& outline_;
    std::vector<Hdf5Array> arrays_ = arrays_of(outline_);
    std::string h5_;
};

}  // namespace

std::string xdmf_text(const MeshOutline& outline, std::string h5) { return XdmfText(outline, std::move(h5)).text(); }

}  // namespace kerf
