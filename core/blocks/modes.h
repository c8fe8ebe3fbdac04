// The mesh that is handed out, made from the layered one: as it is, without the D-bar-surfaces that were
// named, or as coarse as it can be.
#pragma once

#include "certificate/certificate.h"
#include "primal/boundary.h"

namespace dualblock {

enum class Mode : std::uint8_t { layered, coarsest };

inline constexpr double kSameShape = 1e-3; // scaled Jacobians that differ by less count as equal

struct ModeOptions {
  Mode mode = Mode::layered;
  std::vector<Index> extract; // D-bar-surfaces to extract first, in this order
  bool relax = true;
  struct Insert {
    Index facet;  // of the domain as given
    double share; // see insertAlong
    /// Goes with the one before: facets of one name, whose sides get one each, however many facets they have.
    bool isAnother = false;
  };
  std::vector<Insert> insert; // along the sides of these facets, at last
  bool keepsShape = false;    // coarsening may not lower the worst scaled Jacobian
};

template <int N> struct FinalMesh {
  BlockMesh<N> blocks;
  std::vector<Index> extracted;               // D-bar-surfaces, in the order that they went
  std::vector<std::array<Index, 2>> inserted; // D-bar-surface, and the one that it was split from
  Index doubled = 0;                          // of these, the first: so that blocks follow bent sides
  std::vector<double> quality;                // per block: scaled Jacobian
  Certificate certificate;
};

/// `layered` is a valid mesh with its certificate. An Error names a surface that cannot be extracted, or a
/// facet that none can be inserted along, and why. `facetOfGiven`: as in PreparedDomain. Nothing is returned
/// that is not valid.
template <int N>
Result<FinalMesh<N>> makeFinalMesh(const BlockInput<N> &layered, const Certificate &certificate,
                                   const ModeOptions &options, const std::vector<Index> &facetOfGiven);

extern template Result<FinalMesh<2>> makeFinalMesh(const BlockInput<2> &, const Certificate &,
                                                   const ModeOptions &, const std::vector<Index> &);
extern template Result<FinalMesh<3>> makeFinalMesh(const BlockInput<3> &, const Certificate &,
                                                   const ModeOptions &, const std::vector<Index> &);

/// The scaled Jacobian of every block.
template <int N> std::vector<double> qualityOf(const BlockMesh<N> &blocks);

extern template std::vector<double> qualityOf(const BlockMesh<2> &);
extern template std::vector<double> qualityOf(const BlockMesh<3> &);

/// The faces of a block mesh that belong to one block only, and the facets that they lie on.
template <int N>
BoundaryFaces<N> boundaryOf(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface);

extern template BoundaryFaces<2> boundaryOf(const BlockMesh<2> &, const std::vector<Index> &);
extern template BoundaryFaces<3> boundaryOf(const BlockMesh<3> &, const std::vector<Index> &);

} // namespace dualblock
