// OpenCASCADE's general fuse splits all solids at each other, so that a face in which two touch exists once. Every body
// must come out of it whole: its solids are followed through the history, none may be of two bodies, and their volumes
// must add up to that of the body. A face is met once for each solid that has it: first with a body behind it, a second
// time, turned over, with the other in front, which makes it a wall; a face with one body on both sides is left out. A
// solid may come out inside out; it is known by a negative volume, and its faces are turned. At last the two bodies
// that were known to touch must have a vertex in common, else the tolerance was too small. A tolerance of 1e-6 is tried
// first, that of the model alone second and 1e-5 last; the reason for a failure is that of the second.
#include "files/cad/inside/imprint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <BOPAlgo_Builder.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>

#include "base/core/ids.h"
#include "base/core/unique_name.h"
#include "files/cad/inside/face_history.h"
#include "files/cad/inside/healing.h"
#include "surface/soup/region_patches.h"

namespace kerf::cad {

namespace {

// Tolerances as shares of the smallest diagonal, in the order in which they are tried; 0 is that of the model alone.
// Programs round, which leaves gaps where none is meant.
constexpr std::array<double, 3> shares = {1e-6, 0, 1e-5};
constexpr double integration_precision = 1e-6;  // as body_mesher.cpp has it
constexpr double least_volume = 1e-12;          // of the box around a body
constexpr double most_change = 1e-4;            // of the volume of a body

struct Mass {
    double volume;  // negative: turned inside out
    Vec3 middle;
};

Mass mass_of(const TopoDS_Shape& shape) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties, integration_precision);
    const gp_Pnt p = properties.CentreOfMass();
    return {properties.Mass(), {p.X(), p.Y(), p.Z()}};
}

TopTools_IndexedMapOfShape sub_shapes(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
    TopTools_IndexedMapOfShape found;
    TopExp::MapShapes(shape, kind, found);
    return found;
}

// Returns the shapes in the place of a shape.
TopTools_ListOfShape images_of(BOPAlgo_Builder& builder, const TopoDS_Shape& shape) {
    TopTools_ListOfShape images = builder.Modified(shape);
    if (images.IsEmpty() && !builder.IsDeleted(shape)) images.Append(shape);
    return images;
}

// One general fuse, and the bodies in its result.
class GeneralFuse {
 public:
    GeneralFuse(const std::vector<Body>& bodies, const std::vector<Patch>& patches, double tolerance)
        : bodies_(bodies), patches_(patches) {
        builder_.SetNonDestructive(true);  // the next try has the same bodies
        builder_.SetRunParallel(false);
        builder_.SetFuzzyValue(tolerance);
        for (const Body& body : bodies) {
            const TopTools_IndexedMapOfShape solids = sub_shapes(body.shape, TopAbs_SOLID);
            for (int i = 1; i <= solids.Extent(); ++i) builder_.AddArgument(solids(i));
        }
        assembly_.tolerance = tolerance;
    }

    // Returns false with the reason in `failure`.
    bool run(const Contact& contact) {
        builder_.Perform();
        failure.bodies = contact.bodies;
        failure.where = contact.where;
        if (builder_.HasErrors()) return false;
        if (!take_solids() || !keeps_volumes() || !take_faces()) return false;
        failure = {ImprintFailure::Kind::apart, contact.bodies, contact.where};
        return have_common_vertex(contact.bodies);
    }

    Assembly take() { return std::move(assembly_); }

    ImprintFailure failure;

 private:
    struct Piece {
        TopoDS_Shape solid;
        bool is_inside_out = false;
    };

    bool fail(ImprintFailure::Kind kind, std::size_t one, std::size_t other, const Vec3& where) {
        failure = {kind, {one, other}, where};
        return false;
    }

    // Takes the solids of each body. A solid of the result that two bodies have become is their overlap.
    bool take_solids() {
        TopTools_DataMapOfShapeInteger body_of;
        solids_.resize(bodies_.size());
        for (std::int32_t b = 0; b < count_of(bodies_); ++b) {
            const TopTools_IndexedMapOfShape solids = sub_shapes(bodies_[b].shape, TopAbs_SOLID);
            for (int i = 1; i <= solids.Extent(); ++i)
                for (const TopoDS_Shape& image : images_of(builder_, solids(i))) {
                    if (body_of.IsBound(image) && body_of.Find(image) != b)
                        return fail(ImprintFailure::Kind::overlap, body_of.Find(image), b, mass_of(image).middle);
                    if (body_of.Bind(image, b)) solids_[b].push_back({image});
                }
        }
        return true;
    }

    bool keeps_volumes() {
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            const Mass before = mass_of(bodies_[b].shape);
            double after = 0;
            for (Piece& piece : solids_[b]) {
                const double volume = mass_of(piece.solid).volume;
                piece.is_inside_out = volume < 0;
                after += std::abs(volume);
            }
            const double exact = std::abs(before.volume);
            if (!(exact > least_volume * std::pow(diagonal_of(bodies_[b].shape), 3)) ||
                std::abs(after - exact) > most_change * exact)
                return fail(ImprintFailure::Kind::broken, b, b, before.middle);
            assembly_.volumes.push_back(exact);
        }
        return true;
    }

    // Takes the faces of all solids. A face with a body on its other side, too, is met a second time, turned over.
    bool take_faces() {
        TopTools_IndexedMapOfShape faces;
        std::vector<FacetSides> sides;
        for (std::int32_t b = 0; b < count_of(bodies_); ++b)
            for (const auto& [solid, is_inside_out] : solids_[b])
                for (TopExp_Explorer all(solid, TopAbs_FACE); all.More(); all.Next()) {
                    const TopoDS_Shape& face = all.Current();
                    if (face.Orientation() != TopAbs_FORWARD && face.Orientation() != TopAbs_REVERSED) continue;
                    const TopoDS_Shape outwards = is_inside_out ? face.Reversed() : face;
                    const int known = faces.FindIndex(face);
                    if (known == 0) {
                        faces.Add(outwards);
                        sides.push_back({.back = RegionIndex(b)});
                        continue;
                    }
                    FacetSides& both = sides[known - 1];
                    if (both.front.is_valid() || faces(known).Orientation() == outwards.Orientation())
                        return fail(ImprintFailure::Kind::broken, both.back.value(), b, failure.where);
                    both.front = RegionIndex(b);
                }
        return bind_faces(faces, sides);
    }

    // Takes the faces with their patches: one for each face of the file and the regions on its sides.
    bool bind_faces(const TopTools_IndexedMapOfShape& faces, const std::vector<FacetSides>& sides) {
        TopTools_DataMapOfShapeInteger patch_of;
        for (const Body& body : bodies_)
            follow_faces(
                body, [&](const TopoDS_Shape& face) { return images_of(builder_, face); }, patch_of);
        TopoDS_Compound compound;
        BRep_Builder().MakeCompound(compound);
        std::map<std::pair<std::int32_t, FacetSides>, std::int32_t> number_of;
        for (int i = 1; i <= faces.Extent(); ++i) {
            const FacetSides both = sides[i - 1];
            if (both.front == both.back) continue;  // a body touches itself
            if (!patch_of.IsBound(faces(i)))
                return fail(ImprintFailure::Kind::broken, both.back.value(), both.back.value(), failure.where);
            const std::int32_t patch = patch_of.Find(faces(i));
            const auto next = count_of(assembly_.sides);
            const auto [entry, is_new] = number_of.try_emplace({patch, both}, next);
            if (is_new) {
                assembly_.sides.push_back(both);
                assembly_.patches.push_back(patches_[patch]);
            }
            assembly_.faces.patch_of.Bind(faces(i), entry->second);
            BRep_Builder().Add(compound, faces(i));
            assembly_.wall_faces += both.is_wall();
        }
        assembly_.faces.name = "assembly";
        assembly_.faces.shape = compound;
        return true;
    }

    bool have_common_vertex(const std::array<std::size_t, 2>& pair) const {
        TopTools_IndexedMapOfShape of_one;
        for (const Piece& piece : solids_[pair[0]]) TopExp::MapShapes(piece.solid, TopAbs_VERTEX, of_one);
        for (const Piece& piece : solids_[pair[1]])
            for (TopExp_Explorer all(piece.solid, TopAbs_VERTEX); all.More(); all.Next())
                if (of_one.Contains(all.Current())) return true;
        return false;
    }

    const std::vector<Body>& bodies_;
    const std::vector<Patch>& patches_;
    BOPAlgo_Builder builder_;
    std::vector<std::vector<Piece>> solids_;  // by body
    Assembly assembly_;
};

void name_wall_patches(Assembly& assembly, const std::vector<Patch>& of_file) {
    std::set<std::string> taken;
    for (const Patch& patch : of_file) taken.insert(patch.name);
    std::map<std::pair<RegionIndex, RegionIndex>, std::string> name_of;
    for (std::size_t p = 0; p < assembly.sides.size(); ++p) {
        const FacetSides sides = assembly.sides[p];
        if (!sides.is_wall()) continue;
        std::string& name = name_of[{sides.back, sides.front}];
        if (name.empty()) name = unique_name(wall_name(assembly.region_names, sides), taken);
        assembly.patches[p].name = name;
    }
}

}  // namespace

std::vector<std::string> region_names(const std::vector<Body>& bodies) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Body& body : bodies)
        names.push_back(
            unique_name(body.own_name.empty() ? fmt::format("solid_{}", names.size() + 1) : body.own_name, taken));
    return names;
}

Imprint::Imprint(const std::vector<Body>& bodies, const std::vector<Patch>& patches, const Contact& contact) {
    double smallest = diagonal_of(bodies.front().shape);
    for (const Body& body : bodies) smallest = std::min(smallest, diagonal_of(body.shape));
    failure_ = {ImprintFailure::Kind::broken, contact.bodies, contact.where};
    for (const double share : shares) try {
            GeneralFuse fuse(bodies, patches, share * smallest);
            if (fuse.run(contact)) {
                assembly_ = fuse.take();
                assembly_->region_names = region_names(bodies);
                name_wall_patches(*assembly_, patches);
                return;
            }
            if (share == 0) failure_ = fuse.failure;
        } catch (const Standard_Failure&) {  // the same as an error of its own
        }
}

}  // namespace kerf::cad
