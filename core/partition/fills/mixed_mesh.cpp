#include "partition/fills/mixed_mesh.h"

namespace dualblock {
namespace {

template <int N> class Mixer {
public:
  Mixer(const ReferenceMesh<N> &cut, const std::vector<PartSource> &source) : source_(source) {
    result.mesh.size = cut.size;
    result.mesh.smoothCosine = cut.smoothCosine;
    result.mesh.componentCount = cut.componentCount;
    result.mesh.surfaces = cut.surfaces; // all meshes number the domain's facets alike
    if (cut.surfaces.back().kind != SurfaceKind::simplexFace)
      result.mesh.surfaces.push_back({SurfaceKind::simplexFace, kNone, {}});
    inner_ = toIndex(result.mesh.surfaces.size()) - 1;
  }

  /// Appends the components of `from` that have the given source. isPart(simplex): it is a part of its own.
  template <typename IsPart> void append(const ReferenceMesh<N> &from, PartSource wanted, IsPart isPart) {
    ReferenceMesh<N> &mesh = result.mesh;
    std::vector<Index> node(from.nodes.size(), kNone);
    std::vector<Index> simplex(from.simplices.size(), kNone);
    Index next = mesh.simplexCount();
    for (Index s = 0; s < from.simplexCount(); ++s)
      if (source_[at(from.component[at(s)])] == wanted) simplex[at(s)] = next++;
    for (Index s = 0; s < from.simplexCount(); ++s) {
      if (simplex[at(s)] == kNone) continue;
      auto v = from.simplices[at(s)];
      for (Index &n : v) {
        if (node[at(n)] == kNone) {
          node[at(n)] = mesh.nodeCount();
          mesh.nodes.push_back(from.nodes[at(n)]);
          mesh.nodeSimplex.push_back(simplex[at(s)]);
        }
        n = node[at(n)];
      }
      auto neighbors = from.neighbors[at(s)];
      auto tags = from.tags[at(s)];
      for (int i = 0; i < N + 1; ++i) {
        if (neighbors[i] == kNone) continue;
        neighbors[i] = simplex[at(neighbors[i])];
        const bool ofSimplex =
            tags[i] == kNone ? isPart(s)
                             : from.surfaces[at(FaceTag::surface(tags[i]))].kind == SurfaceKind::simplexFace;
        if (ofSimplex)
          tags[i] = simplex[at(s)] < neighbors[i] ? FaceTag::back(inner_) : FaceTag::front(inner_);
      }
      mesh.simplices.push_back(v);
      mesh.neighbors.push_back(neighbors);
      mesh.tags.push_back(tags);
      mesh.region.push_back(from.region[at(s)]);
      mesh.component.push_back(from.component[at(s)]);
      result.everyFace.push_back(isPart(s));
    }
  }

  MixedMesh<N> result;

private:
  const std::vector<PartSource> &source_;
  Index inner_ = kNone;
};

} // namespace

template <int N>
MixedMesh<N> mixMeshes(const ReferenceMesh<N> &cut, const ReferenceMesh<N> *pulled,
                       const std::vector<bool> *pulledFace, const ReferenceMesh<N> *coarse,
                       const std::vector<PartSource> &source) {
  Mixer<N> mixer(cut, source);
  mixer.append(cut, PartSource::cuts, [](Index) { return false; });
  if (pulled) mixer.append(*pulled, PartSource::pulled, [&](Index s) { return (*pulledFace)[at(s)]; });
  if (coarse) mixer.append(*coarse, PartSource::simplices, [](Index) { return true; });
  return std::move(mixer.result);
}

template MixedMesh<2> mixMeshes(const ReferenceMesh<2> &, const ReferenceMesh<2> *, const std::vector<bool> *,
                                const ReferenceMesh<2> *, const std::vector<PartSource> &);
template MixedMesh<3> mixMeshes(const ReferenceMesh<3> &, const ReferenceMesh<3> *, const std::vector<bool> *,
                                const ReferenceMesh<3> *, const std::vector<PartSource> &);

} // namespace dualblock
