// The tetrahedra of a reference mesh to edit, and what each node of them lies on.
#pragma once

#include "blocks/bent_shape.h"
#include "parts/parts.h"
#include "remesh/tet_mesh.h"

namespace dualblock {

/// `features`: the mesh's parts; `shape`: of its bent sides, with their creases. Nodes of curves and sides
/// may move along them; where more meets, or a crease ends or turns, they may not.
TetMesh loadTets(const ReferenceMesh<3> &mesh, const Parts<3> &features, const BentShape<3> &shape);

} // namespace dualblock
