// Domains and parts beside the project, judged by code that shares nothing with the core: whatever gets a
// certificate has no overlap, no fold, and its volume. It takes minutes under the sanitizers, so it runs
// where DUALBLOCK_SHARED is set.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include <gtest/gtest.h>

#include "io/read_domain.h"
#include "pipeline.h"
#include "support/examples.h"
#include "support/mesh_judge.h"

namespace dualblock::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> domainFiles() {
  const fs::path shared = fs::path(DUALBLOCK_SOURCE_DIR) / ".." / "shared";
  std::vector<fs::path> files;
  for (const char *folder : {"cases/adversarial", "cases/reported", "parts/cad"}) {
    if (!fs::exists(shared / folder)) continue;
    for (const auto &entry : fs::directory_iterator(shared / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".json" || ending == ".off" || ending == ".poly") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What the judge says of a file's mesh; how it ended where there is none to judge.
std::string verdictOn(const fs::path &file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  const auto read = readDomain(file.extension().string().substr(1), text.str());
  if (!read.ok()) return "not read: " + read.error().message;
  if (!std::holds_alternative<Domain<3>>(read.value())) return "in the plane";
  PipelineOptions options;
  options.timeLimit = 300;
  const auto result = runPipeline<3>(std::get<Domain<3>>(read.value()), options);
  if (!result.ok()) return "no mesh: " + result.error().message;
  const auto &r = result.value();
  if (!r.certificate.valid) return "not certified: " + failuresOf(r.certificate);
  Index regions = 0;
  for (const Index region : r.mesh.region) regions = std::max(regions, region);
  if (regions > 0) return "an assembly: interfaces would wind around points twice";
  HexMesh mesh{r.primal.positions, {}};
  for (const Block<3> &b : r.primal.blocks) mesh.blocks.push_back(b.nodes);
  const Verdict verdict = judge(r.domain.domain, mesh, {});
  EXPECT_EQ(verdict.complaint, "") << file;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "judged: %zu blocks, overlap %.2f %%, lost %.1f %%, excess %.1f %%",
                mesh.blocks.size(), 100 * verdict.overlap, 100 * verdict.lost, 100 * verdict.excess);
  return numbers;
}

TEST(SharedDomains, TheJudgeObjectsToNoMesh) {
  if (!std::getenv("DUALBLOCK_SHARED")) GTEST_SKIP() << "takes minutes: set DUALBLOCK_SHARED to run it";
  const std::vector<fs::path> files = domainFiles();
  if (files.empty()) GTEST_SKIP() << "there is no folder ../shared";
  for (const fs::path &file : files)
    std::cout << file.filename().string() << ": " << verdictOn(file) << std::endl;
}

} // namespace
} // namespace dualblock::test
