// Parts, sides, curves and corners (ARCHITECTURE.md 2 and 3): the polytopes that the split surfaces cut the
// domain into. With no split surface yet, the parts are the domain's components and their sides, curves
// and corners are the domain's own features.
#pragma once

#include <memory>
#include <numbers>
#include <span>

#include "parts/defects.h"
#include "reference/reference_mesh.h"

namespace dualblock {

/// A maximal smooth piece of a part's boundary.
struct Side {
  Index part;
  Index tag;      // the FaceTag of its first face; all its faces have the same ReferenceMesh::sideKey
  Index opposite; // the side of the neighbouring part on the same split surface, or kNone
};

/// What a cut through a ridge of a curve has to know.
template <int N> struct RidgeFrame {
  std::array<Index, 2> tags; // of the faces on the curve's two sides
  Vec<N> outward;            // normal of the first of them
  Vec<N> into;               // in its plane, perpendicular to the ridge, into the side
  double angle;              // inside the part, radians
};

/// The faces of a part where two of its sides meet: a chain of ridges (3D), one node (2D).
template <int N> struct Curve {
  Index part;
  std::array<Index, 2> sides;                         // ascending
  std::span<const std::array<Index, N - 1>> ridges{}; // node lists, ascending
  std::span<const RidgeFrame<N>> frames{};            // per ridge, where the angle is above kFlatAngle
  double angle = 0;                                   // inside the part, at the longest ridge, radians
  bool open = true;                                   // a chain with two ends that are corners (2D: always)
};

/// Radians: a block cannot fill a flat corner, and badly what is nearly flat. Cuts go through curves above
/// it.
inline constexpr double kFlatAngle = 170 * std::numbers::pi / 180;

/// A node where at least N sides of a part meet, or two in a curve that turns sharply there.
struct Corner {
  Index part;
  Index node;
  std::span<const Index> sides; // ascending
};

struct PartInfo {
  Defect defect = Defect::none; // the first that was found
  Index region = 0;
  bool isSimple() const { return defect == Defect::none; } // condition (c) of ARCHITECTURE.md 2
};

/// What the curves and corners of parts consist of, one after the other: there are too many of them to have
/// vectors of their own.
template <int N> struct FeatureStore {
  std::vector<std::array<Index, N - 1>> ridges;
  std::vector<RidgeFrame<N>> frames;
  std::vector<Index> cornerSides;
};

template <int N> struct Parts {
  std::vector<PartInfo> parts;
  std::vector<Index> partOfSimplex;
  std::vector<Side> sides;
  Lists<FaceRef<N>> sideFaces;                  // per side
  Lists<Index> nodeSides;                       // per node: all sides it lies on, of any part, ascending
  std::vector<Curve<N>> curves;                 // by part, then sides
  std::vector<Corner> corners;                  // by part, then node
  Lists<Index> partSides;                       // per part
  std::shared_ptr<const FeatureStore<N>> store; // of curves and corners; copies share it
};

/// A corner of a side on a split surface that the side behind it does not have, so that blocks would not fit.
struct UnlikeCorner {
  Index part; // the one that lacks it
  Index node;
};

/// In the order of the sides that have them.
template <int N> std::vector<UnlikeCorner> unlikeCorners(const Parts<N> &parts);

struct PartOptions {
  const std::vector<bool> *everyFace = nullptr; // per simplex: true where each face is a side of its own
};

/// What was found before some simplices of the mesh were divided, and the parts where it still holds: those
/// without new simplices.
template <typename Found> struct Earlier {
  Found found{};
  std::vector<bool> holds{}; // per part
};

/// Parts of a mesh that has been divided since, inside of some parts: their boundaries are as they were.
template <int N> Earlier<Parts<N>> earlierParts(const ReferenceMesh<N> &mesh, Parts<N> parts) {
  Earlier<Parts<N>> earlier{std::move(parts), {}};
  earlier.holds.assign(earlier.found.parts.size(), true);
  const Index count = toIndex(earlier.found.partOfSimplex.size());
  for (Index s = count; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) { // new pieces stand beside one that has kept its number
      const Index t = mesh.neighbors[at(s)][i];
      if (t != kNone && t < count && mesh.tags[at(s)][i] == kNone)
        earlier.holds[at(earlier.found.partOfSimplex[at(t)])] = false;
    }
  return earlier;
}

/// Finds the parts that the mesh's tagged faces bound. Linear in the simplices; sorting is confined to the
/// boundary faces.
template <int N>
Parts<N> buildParts(const ReferenceMesh<N> &mesh, const PartOptions &options,
                    const Earlier<Parts<N>> &earlier = {});

/// The component that each part belongs to.
template <int N> std::vector<Index> componentOfParts(const ReferenceMesh<N> &mesh, const Parts<N> &parts) {
  std::vector<Index> component(parts.parts.size(), 0);
  // Cuts may have added simplices since; those that were there have kept their number, in a piece of
  // themselves.
  for (std::size_t s = 0; s < parts.partOfSimplex.size(); ++s)
    component[at(parts.partOfSimplex[s])] = mesh.component[s];
  return component;
}

extern template std::vector<UnlikeCorner> unlikeCorners(const Parts<2> &);
extern template std::vector<UnlikeCorner> unlikeCorners(const Parts<3> &);
extern template Parts<2> buildParts(const ReferenceMesh<2> &, const PartOptions &, const Earlier<Parts<2>> &);
extern template Parts<3> buildParts(const ReferenceMesh<3> &, const PartOptions &, const Earlier<Parts<3>> &);

} // namespace dualblock
