// One measured run: dualblock-bench CASE EDGE MODE, where CASE is cube or scaffold and EDGE the edge length
// of the reference mesh. MODE "run" runs the pipeline, "tetgen" TetGen alone, so that its own peak memory is
// seen; both print one line of JSON. "off" prints the domain, for other programs. tests/bench/bench.mjs calls
// it.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>

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
  for (const Vec<3> &v : domain.vertices) std::printf("%g %g %g\n", v.x, v.y, v.z);
  for (const Facet &f : domain.facets)
    std::printf("4 %d %d %d %d\n", f.loops[0][0], f.loops[0][1], f.loops[0][2], f.loops[0][3]);
}

int measureTetgen(const Domain<3> &domain, double edge) {
  const auto prepared = prepareDomain(domain, 1e-6);
  if (!prepared.ok()) return 1;
  TetgenOptions options{domainSize(domain.vertices)};
  options.maxVolume = edge * edge * edge / (6 * std::numbers::sqrt2);
  const auto made = runTetgen(prepared.value().domain.vertices, prepared.value().domain.facets, options);
  if (!made.ok()) return 1;
  std::printf("{\"tetgen\": %.1f, \"peak\": %.0f}\n", made.value().milliseconds, peakMegabytes());
  return 0;
}

int measureRun(const Domain<3> &domain, double edge) {
  PipelineOptions options;
  options.edgeLength = edge;
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

} // namespace

int main(int argc, char **argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: dualblock-bench cube|scaffold EDGE run|tetgen|off\n");
    return 2;
  }
  const bool isCube = std::strcmp(argv[1], "cube") == 0;
  const auto full = [](int, int, int) { return true; };
  const Domain<3> domain = isCube ? test::voxelDomain(1, full) : test::scaffold(20, 4);
  const double edge = std::atof(argv[2]);
  if (std::strcmp(argv[3], "tetgen") == 0) return measureTetgen(domain, edge);
  if (std::strcmp(argv[3], "run") == 0) return measureRun(domain, edge);
  printOff(domain);
  return 0;
}
