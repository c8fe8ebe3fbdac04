// A time limit ends a run with an error of its own, wherever it is, and leaves nothing behind.
#include <chrono>

#include <gtest/gtest.h>

#include "support/bent_domains.h"
#include "support/random_domains.h"

namespace dualblock::test {
namespace {

TEST(Deadline, EndsARunWithAnError) {
  PipelineOptions options;
  options.edgeLength = 0.05; // some hundred thousand tetrahedra
  options.timeLimit = 0.02;
  const auto result = runPipeline<3>(loadExample<3>("protrusion"), options);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::timeLimit);
  EXPECT_NE(result.error().message.find("limit of 0.02 s: raise it"), std::string::npos);
}

TEST(Deadline, DoesNotOutliveItsRun) {
  PipelineOptions options;
  options.timeLimit = 1e-9;
  EXPECT_FALSE(runPipeline<3>(loadExample<3>("protrusion"), options).ok());
  EXPECT_TRUE(run(loadExample<3>("protrusion")).certificate.valid);
  options.timeLimit = 600;
  EXPECT_TRUE(run(loadExample<3>("protrusion"), options).certificate.valid);
}

// What is valid, but poor or far from a side, is handed out where the limit comes while better is sought.
TEST(Deadline, HandsOutWhatThereIs) {
  const Domain<3> domain = bentSolid(1, 1);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(run(domain).isCutShort);
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  int cutShort = 0;
  for (double share = 0.1; share < 1; share += 0.05) { // the machine may be busier now than before
    PipelineOptions options;
    options.timeLimit = share * whole;
    const auto result = runPipeline<3>(domain, options);
    if (!result.ok()) {
      EXPECT_EQ(result.error().code, ErrorCode::timeLimit);
      continue;
    }
    EXPECT_TRUE(result.value().certificate.valid) << failuresOf(result.value().certificate);
    cutShort += result.value().isCutShort;
  }
  EXPECT_GT(cutShort, 0);
}

} // namespace
} // namespace dualblock::test
