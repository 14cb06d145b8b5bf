// Follows the patches of faces through algorithms of OpenCASCADE that change the faces.
#pragma once

#include <TopAbs.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include "files/cad/inside/model.h"

namespace kerf::cad {

/// Binds the images of the faces of a body to their patches. `images(face)`: the shapes in the place of the face, which
/// may be null. Goes in the order of the faces, never in that of the map, which is one of addresses; the first patch
/// stays.
template <class Images>
void follow_faces(const Body& old, const Images& images, TopTools_DataMapOfShapeInteger& patch_of) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(old.shape, TopAbs_FACE, faces);
    for (int i = 1; i <= faces.Extent(); ++i) {
        const std::int32_t patch = old.patch_of.Find(faces(i));
        for (const TopoDS_Shape& image : images(faces(i))) {
            if (image.IsNull()) continue;
            for (TopExp_Explorer pieces(image, TopAbs_FACE); pieces.More(); pieces.Next())
                if (!patch_of.IsBound(pieces.Current())) patch_of.Bind(pieces.Current(), patch);
        }
    }
}

/// Tells whether every face of the shape has a patch.
inline bool knows_all_faces(const TopoDS_Shape& shape, const TopTools_DataMapOfShapeInteger& patch_of) {
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
        if (!patch_of.IsBound(faces.Current())) return false;
    return true;
}

}  // namespace kerf::cad
