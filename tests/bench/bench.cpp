// One measured run: dualblock-bench CASE EDGE MODE, where CASE is cube, scaffold, voxels or cells and EDGE
// the edge length of the reference mesh, 0 for the coarsest. MODE "run" runs the pipeline without relaxation,
// "tetgen" TetGen alone, so that its own peak memory is seen, "mesh" relaxes the blocks and refines them to a
// million elements; each prints one line of JSON. "off" prints the domain, for other programs.
// tests/bench/bench.mjs calls it.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>

#include "certificate/elements.h"
#include "domain/prepare.h"
#include "pipeline.h"
#include "reference/tetgen_adaptor.h"
#include "support/voxels.h"

using namespace dualblock;

namespace {

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void printOff(const Domain<3> &domain) {
  std::printf("OFF\n%zu %zu 0\n", domain.vertices.size(), domain.facets.size());
  for (const Vec<3> &v : domain.vertices) std::printf("%.17g %.17g %.17g\n", v.x, v.y, v.z);
  for (const Facet &f : domain.facets)
    std::printf("4 %d %d %d %d\n", f.loops[0][0], f.loops[0][1], f.loops[0][2], f.loops[0][3]);
}

int measureTetgen(const Domain<3> &domain, double edge) {
  const auto prepared = prepareDomain(domain, 1e-6);
  if (!prepared.ok()) return 1;
  TetgenOptions options{domainSize(domain.vertices)};
  options.onGrid = false; // TetGen as it is
  options.maxVolume = edge * edge * edge / (6 * std::numbers::sqrt2);
  const auto made = runTetgen(prepared.value().domain.vertices, prepared.value().domain.facets, options);
  if (!made.ok()) return 1;
  std::printf("{\"tetgen\": %.1f, \"peak\": %.0f}\n", made.value().milliseconds, peakMegabytes());
  return 0;
}

int measureRun(const Domain<3> &domain, double edge) {
  PipelineOptions options;
  options.edgeLength = edge;
  options.mode.relax = false;
  const auto run = runPipeline<3>(domain, options);
  if (!run.ok()) {
    std::fprintf(stderr, "%s\n", run.error().message.c_str());
    return 1;
  }
  const auto &r = run.value();
  std::printf("{\"filled\": %d, \"blocks\": %zu, \"valid\": %s, \"peak\": %.0f, \"timings\": {",
              r.fillSimplices, r.primal.blocks.size(), r.certificate.valid ? "true" : "false",
              peakMegabytes());
  const char *comma = "";
  for (const StageTime &t : r.timings) {
    std::printf("%s\"%s\": %.1f", comma, t.stage, t.milliseconds);
    comma = ", ";
  }
  std::printf("}}\n");
  return 0;
}

/// `count` cells at random of a grid of `grid` cells each way.
Domain<3> randomCells(int grid, int count, std::mt19937 &random) {
  std::vector<bool> isFull(at(grid * grid * grid), false);
  while (count > 0) {
    const std::size_t cell = random() % isFull.size();
    if (isFull[cell]) continue;
    isFull[cell] = true;
    --count;
  }
  return test::voxelDomain(
      grid, [&](int i, int j, int k) { return isFull[at((i * grid + j) * grid + k)] ? 1 : 0; });
}

/// 1,300 cells of a grid of 14 by 14 by 14 planes at random distances: about 10,000 blocks of all sizes.
Domain<3> cells() {
  constexpr int kGrid = 14;
  std::mt19937 random(1);
  Domain<3> domain = randomCells(kGrid, 1300, random);
  std::array<std::array<double, kGrid + 1>, 3> planes{};
  for (auto &along : planes)
    for (int k = 0; k < kGrid; ++k)
      along[at(k + 1)] = along[at(k)] + 1 + static_cast<double>(random() % 1000) / 1000;
  for (Vec<3> &v : domain.vertices)
    for (int a = 0; a < 3; ++a) v[a] = planes[at(a)][static_cast<std::size_t>(v[a])];
  return domain;
}

int measureMesh(const Domain<3> &domain, double edge) {
  PipelineOptions options;
  options.edgeLength = edge;
  const auto run = runPipeline<3>(domain, options);
  if (!run.ok() || !run.value().certificate.valid) return 1;
  double relaxation = 0;
  for (const StageTime &t : run.value().timings)
    if (std::strcmp(t.stage, "relaxation") == 0) relaxation = t.milliseconds;
  RefineOptions wanted;
  const auto blocks = static_cast<double>(run.value().primal.blocks.size());
  wanted.intervals = static_cast<Index>(std::ceil(std::cbrt(1e6 / blocks)));
  const auto start = std::chrono::steady_clock::now();
  const PipelineResult<3> &r = run.value();
  const auto refined = refineResult(r, wanted);
  if (!refined.ok()) return 1;
  const BlockMesh<3> layered = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Certificate certificate = certifyElements<3>(
      {refined.value(), layered, patchOfSurface(r.mesh), {}, r.certificate.domainMeasure, false});
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  if (!certificate.valid) return 1;
  std::printf(
      "{\"blocks\": %.0f, \"relaxation\": %.1f, \"intervals\": %d, \"elements\": %zu, \"refinement\": "
      "%.1f}\n",
      blocks, relaxation, wanted.intervals, refined.value().elements.size(), took.count());
  return 0;
}

} // namespace

int main(int argc, char **argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: dualblock-bench cube|scaffold|voxels|cells EDGE run|tetgen|mesh|off\n");
    return 2;
  }
  const auto is = [&](const char *name) { return std::strcmp(argv[1], name) == 0; };
  const auto full = [](int, int, int) { return 1; };
  std::mt19937 random(1);
  const Domain<3> domain = is("cells")    ? cells()
                           : is("voxels") ? randomCells(20, 4000, random)
                           : is("cube")   ? test::voxelDomain(1, full)
                                          : test::scaffold(20, 4);
  const double edge = std::atof(argv[2]);
  if (std::strcmp(argv[3], "tetgen") == 0) return measureTetgen(domain, edge);
  if (std::strcmp(argv[3], "run") == 0) return measureRun(domain, edge);
  if (std::strcmp(argv[3], "mesh") == 0) return measureMesh(domain, edge);
  printOff(domain);
  return 0;
}
