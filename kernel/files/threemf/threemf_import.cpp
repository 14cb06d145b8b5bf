// Build items place objects; an object has a mesh of its own, or is made of components, which place other objects. So
// the way down from an item to a mesh gives its place, by the product of all transformations, and its name. A
// transformation that mirrors would turn facets inside out, so these are turned then. Objects are counted from the text
// before lib3mf reads it (files/threemf/inside/placed_objects.h), since it follows components without a limit; the
// limits are checked again on the way down, for objects, levels and facets. The library is optional: only the program
// kerf-3mf links it, whose answer is a CadBody as that of kerf-cad is.
#include "files/threemf/threemf_import.h"

#include <map>
#include <utility>

#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/io/soup_builder.h"
#include "files/io/threemf_file.h"
#include "files/io/zip_archive.h"
#include "files/threemf/inside/placed_objects.h"

namespace kerf {

namespace {

// Limits: components may repeat objects of components, so that a few lines of a file stand for any number of facets.
constexpr std::int64_t most_placed_facets = 100'000'000;
constexpr std::uint64_t most_placed_objects = 100'000;
constexpr int most_levels = 100;

/// An object of lib3mf, which is released with this.
class Handle {
 public:
    Handle() = default;
    ~Handle() {
        if (pointer_) NMR::lib3mf_release(pointer_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    NMR::PLib3MFBase* get() const { return pointer_; }
    NMR::PLib3MFBase** out() { return &pointer_; }

 private:
    NMR::PLib3MFBase* pointer_ = nullptr;
};

// Returns a transformation; lib3mf has the rows of its matrix, each with the row's share of the shift behind it.
Eigen::Affine3d placement_of(const NMR::MODELTRANSFORM& transform) {
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) placement(row, column) = transform.m_fFields[row][column];
    return placement;
}

struct FileUnit {
    const char* name;
    double millimetres;
};

class ThreemfReader {
 public:
    ThreemfReader(const std::string& path, const CadOptions& options)
        : path_(path), options_(options), builder_(path) {}

    CadBody read(std::string_view content) {
        open(content);
        find_unit();
        add_items();
        CadBody body;
        body.soup = builder_.finish();
        body.format = "3MF";
        body.file_unit = unit_.name;
        body.unit = length_unit_names()[static_cast<std::size_t>(options_.unit)];
        body.solids = items_;
        body.faces = count_of(body.soup.patch_names);
        body.soup.notes.insert(
            body.soup.notes.begin(),
            fmt::format("3MF: unit {} -> {}, {} build item{}, {} object{}.", body.file_unit, body.unit, items_,
                        items_ == 1 ? "" : "s", body.faces, body.faces == 1 ? "" : "s"));
        return body;
    }

 private:
    [[noreturn]] void refuse(const std::string& what) const { throw Error(ErrorCode::input, path_ + ": " + what); }
    // Checks the status of a call of lib3mf: 0 is success.
    void require(int status) const {
        if (status != 0) refuse("lib3mf cannot read this 3MF file. Export it again, or as STL, OBJ or PLY.");
    }

    void open(std::string_view content) {
        refuse_repetition_in(content);  // lib3mf follows components while it reads, and would not come back
        require(NMR::lib3mf_createmodel(model_.out()));
        Handle reader;
        require(NMR::lib3mf_model_queryreader(model_.get(), "3mf", reader.out()));
        auto* bytes = reinterpret_cast<BYTE*>(const_cast<char*>(content.data()));
        if (NMR::lib3mf_reader_readfrombuffer(reader.get(), bytes, content.size()) != 0) {
            DWORD code = 0;
            const char* reason = nullptr;
            NMR::lib3mf_getlasterror(reader.get(), &code, &reason);
            refuse(fmt::format("lib3mf cannot read this 3MF file ({}). Export it again, or as STL, OBJ or PLY.",
                               reason ? reason : "no reason given"));
        }
        DWORD warnings = 0;
        require(NMR::lib3mf_reader_getwarningcount(reader.get(), &warnings));
        builder_.note_ignored(warnings, "thing that lib3mf warns of", "things that lib3mf warns of");
    }

    void refuse_repetition_in(std::string_view content) const {
        for (const ZipEntry& entry : zip_entries(content, path_)) {
            if (!entry.name.ends_with(".model")) continue;
            const PlacedObjects placed = count_placed_objects(content_of_entry(content, entry, path_));
            if (placed.objects > most_placed_objects || placed.levels > most_levels) refuse_repetition();
        }
    }

    void find_unit() {
        constexpr std::array<FileUnit, 6> units = {
            {{"micron", 0.001}, {"mm", 1}, {"cm", 10}, {"inch", 25.4}, {"ft", 304.8}, {"m", 1000}}};
        DWORD unit = 0;
        require(NMR::lib3mf_model_getunit(model_.get(), &unit));
        if (unit >= units.size()) refuse("the unit of length is unknown. Export it again in mm.");
        unit_ = units[unit];
        scale_ = unit_.millimetres / millimetres_of(options_.unit);
    }

    void add_items() {
        Handle iterator;
        require(NMR::lib3mf_model_getbuilditems(model_.get(), iterator.out()));
        std::int32_t number = 0;
        for (BOOL has_next = 0;;) {
            require(NMR::lib3mf_builditemiterator_movenext(iterator.get(), &has_next));
            if (!has_next) break;
            Handle item;
            require(NMR::lib3mf_builditemiterator_getcurrent(iterator.get(), item.out()));
            if (++number == options_.solid || options_.solid == 0) add_item(item);
        }
        if (options_.solid > number)
            throw Error(ErrorCode::usage, fmt::format("--solid is {}, but {} has {} build item{}.", options_.solid,
                                                      path_, number, number == 1 ? "" : "s"));
        builder_.note_ignored(supports_, "object that supports others", "objects that support others");
    }

    void add_item(const Handle& item) {
        ++items_;
        BOOL is_placed = 0;
        NMR::MODELTRANSFORM transform;
        Eigen::Affine3d placement = Eigen::Affine3d::Identity();
        require(NMR::lib3mf_builditem_hasobjecttransform(item.get(), &is_placed));
        if (is_placed) {
            require(NMR::lib3mf_builditem_getobjecttransform(item.get(), &transform));
            placement = placement_of(transform);
        }
        Handle object;
        DWORD id = 0;
        require(NMR::lib3mf_builditem_getobjectresource(item.get(), object.out()));
        require(NMR::lib3mf_builditem_getobjectresourceid(item.get(), &id));
        add_object(object, id, placement, "", 0);
    }

    void add_object(const Handle& object, DWORD id, const Eigen::Affine3d& placement, const std::string& parent,
                    int level) {
        if (level == most_levels || ++placed_objects_ > most_placed_objects) refuse_repetition();
        DWORD type = 0;
        require(NMR::lib3mf_object_gettype(object.get(), &type));
        if (type == NMR::MODELOBJECTTYPE_SUPPORT || type == NMR::MODELOBJECTTYPE_SOLIDSUPPORT) {
            ++supports_;
            return;
        }
        const std::string name = parent + name_of(object, id);
        BOOL is_mesh = 0;
        require(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh));
        if (is_mesh)
            add_mesh(id, placement, name);
        else
            add_components(id, placement, name + "/", level);
    }

    std::string name_of(const Handle& object, DWORD id) const {
        ULONG size = 0;  // with the zero at the end
        require(NMR::lib3mf_object_getnameutf8(object.get(), nullptr, 0, &size));
        std::string name(size + std::size_t{1}, '\0');
        require(NMR::lib3mf_object_getnameutf8(object.get(), name.data(), name.size(), &size));
        name.resize(name.find('\0'));
        return name.empty() ? fmt::format("object {}", id) : name;
    }

    void add_components(DWORD id, const Eigen::Affine3d& placement, const std::string& name, int level) {
        Handle components;
        DWORD count = 0;
        require(NMR::lib3mf_model_getcomponentsobjectbyid(model_.get(), id, components.out()));
        require(NMR::lib3mf_componentsobject_getcomponentcount(components.get(), &count));
        for (DWORD i = 0; i < count; ++i) {
            Handle component, object;
            BOOL is_placed = 0;
            NMR::MODELTRANSFORM transform;
            Eigen::Affine3d own = Eigen::Affine3d::Identity();
            require(NMR::lib3mf_componentsobject_getcomponent(components.get(), i, component.out()));
            require(NMR::lib3mf_component_hastransform(component.get(), &is_placed));
            if (is_placed) {
                require(NMR::lib3mf_component_gettransform(component.get(), &transform));
                own = placement_of(transform);
            }
            DWORD object_id = 0;
            require(NMR::lib3mf_component_getobjectresource(component.get(), object.out()));
            require(NMR::lib3mf_component_getobjectresourceid(component.get(), &object_id));
            add_object(object, object_id, placement * own, name, level + 1);
        }
    }

    void add_mesh(DWORD id, const Eigen::Affine3d& placement, const std::string& name) {
        Handle mesh;
        DWORD vertex_count = 0, facet_count = 0, written = 0;
        require(NMR::lib3mf_model_getmeshobjectbyid(model_.get(), id, mesh.out()));
        require(NMR::lib3mf_meshobject_getvertexcount(mesh.get(), &vertex_count));
        require(NMR::lib3mf_meshobject_gettrianglecount(mesh.get(), &facet_count));
        placed_facets_ += facet_count;
        if (placed_facets_ > most_placed_facets) refuse_repetition();
        if (facet_count == 0) return;
        std::vector<NMR::MODELMESHVERTEX> vertices(vertex_count);
        std::vector<NMR::MODELMESHTRIANGLE> facets(facet_count);
        require(NMR::lib3mf_meshobject_getvertices(mesh.get(), vertices.data(), vertex_count, &written));
        require(NMR::lib3mf_meshobject_gettriangleindices(mesh.get(), facets.data(), facet_count, &written));
        const std::int64_t first = builder_.vertex_count();
        for (const NMR::MODELMESHVERTEX& vertex : vertices) {
            const Vec3 p(vertex.m_fPosition[0], vertex.m_fPosition[1], vertex.m_fPosition[2]);
            builder_.add_vertex(scale_ * (placement * p));
        }
        const int placed = ++placed_[name];
        builder_.set_patch(placed == 1 ? name : fmt::format("{} {}", name, placed));
        const bool mirrors = placement.linear().determinant() < 0;  // turns facets inside out
        for (const NMR::MODELMESHTRIANGLE& facet : facets) {
            const std::array<std::int64_t, 3> corners = {first + facet.m_nIndices[0],
                                                         first + facet.m_nIndices[mirrors ? 2 : 1],
                                                         first + facet.m_nIndices[mirrors ? 1 : 2]};
            builder_.add_polygon(corners, [&](const std::string& what) { refuse(what); });
        }
    }

    [[noreturn]] void refuse_repetition() const {
        refuse(
            fmt::format("components repeat objects to more than {} facets, {} objects or {} levels. Export what is "
                        "needed of it.",
                        most_placed_facets, most_placed_objects, most_levels));
    }

    const std::string& path_;
    const CadOptions& options_;
    SoupBuilder builder_;
    Handle model_;
    FileUnit unit_ = {};
    double scale_ = 1;  // from the unit of the file to the wanted one
    std::int32_t items_ = 0, supports_ = 0;
    std::uint64_t placed_objects_ = 0;
    std::int64_t placed_facets_ = 0;
    std::map<std::string, int> placed_;  // number of placements by name
};

}  // namespace

CadBody import_threemf(std::string_view content, const std::string& path, const CadOptions& options) {
    for (const auto& [name, is_given] : {std::pair("unite", options.unite), std::pair("no-imprint", options.no_imprint),
                                         std::pair("cad-deflection", options.deflection > 0)})
        if (is_given)
            throw Error(ErrorCode::usage,
                        fmt::format("{} is a 3MF file, which has triangles already, so that --{} has no meaning. "
                                    "Leave it out.",
                                    path, name));
    if (!is_threemf(content))
        throw Error(ErrorCode::input, path + ": this is no 3MF file. Give it to kerf, which knows other formats.");
    check_growth_of_zip(content, path);
    return ThreemfReader(path, options).read(content);
}

}  // namespace kerf
