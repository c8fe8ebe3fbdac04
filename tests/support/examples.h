// The examples of public/examples, and domains made on the spot, for tests.
#pragma once

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "pipeline.h"

namespace dualblock::test {

std::string readText(const std::string &path);

AnyDomain loadExample(const std::string &name);

template <int N> Domain<N> loadExample(const std::string &name) {
  return std::get<Domain<N>>(loadExample(name));
}

/// The names in public/examples/index.json, in its order.
std::vector<std::string> exampleNames();

/// Those whose contributions are assigned by the method, not given.
std::vector<std::string> computedExampleNames();

/// Runs the pipeline; throws where it returns an error, which none of the tests' domains should.
template <int N> PipelineResult<N> run(const Domain<N> &domain, const PipelineOptions &options = {});

/// The reference mesh alone, as the pipeline makes it.
template <int N>
ReferenceMesh<N> fill(const Domain<N> &domain, double edgeLength = 0, std::uint32_t seed = 0,
                      double featureAngle = -1);

/// For the first few failures of a certificate in a test's output.
std::string failuresOf(const Certificate &certificate);

template <int N> double minimumQuality(const PipelineResult<N> &result) {
  return result.quality.empty() ? 0 : *std::min_element(result.quality.begin(), result.quality.end());
}

/// A prism over a closed polygon given counter-clockwise, between two heights.
Domain<3> prism(const std::vector<Vec<2>> &polygon, double bottom, double top);

} // namespace dualblock::test
