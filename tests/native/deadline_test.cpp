// A time limit ends a run with an error of its own, wherever it is, and leaves nothing behind.
#include <gtest/gtest.h>

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

} // namespace
} // namespace dualblock::test
