// The examples of public/examples, and domains made on the spot, for tests.
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/read_json.h"
#include "pipeline.h"

namespace dualblock::test {

inline std::string readText(const std::string &path) {
  std::ifstream file(std::string(DUALBLOCK_SOURCE_DIR) + "/" + path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline AnyDomain loadExample(const std::string &name) {
  auto read = readJson(readText("public/examples/" + name + ".json"));
  if (!read.ok()) throw std::runtime_error(name + ": " + read.error().message);
  return std::move(read.value());
}

template <int N> Domain<N> loadExample(const std::string &name) {
  return std::get<Domain<N>>(loadExample(name));
}

/// The names in public/examples/index.json, in its order.
inline std::vector<std::string> exampleNames() {
  std::vector<std::string> names;
  const auto index = nlohmann::json::parse(readText("public/examples/index.json"));
  for (const auto &example : index.at("examples")) names.push_back(example.at("name").get<std::string>());
  return names;
}

/// Those whose contributions are assigned by the method, not given.
inline std::vector<std::string> computedExampleNames() {
  std::vector<std::string> names;
  for (const std::string &name : exampleNames())
    if (std::visit([](const auto &d) { return d.contributions.empty(); }, loadExample(name)))
      names.push_back(name);
  return names;
}

/// Runs the pipeline; throws where it returns an error, which none of the tests' domains should.
template <int N> PipelineResult<N> run(const Domain<N> &domain, const PipelineOptions &options = {}) {
  auto result = runPipeline<N>(domain, options);
  if (!result.ok()) throw std::runtime_error(domain.name + ": " + result.error().message);
  return std::move(result.value());
}

/// The reference mesh alone, as the pipeline makes it.
template <int N>
ReferenceMesh<N> fill(const Domain<N> &domain, double edgeLength = 0, std::uint32_t seed = 0,
                      double featureAngle = -1) {
  auto prepared = prepareDomain(domain, PipelineOptions{}.tolerance);
  if (!prepared.ok()) throw std::runtime_error(domain.name + ": " + prepared.error().message);
  FillOptions options;
  options.edgeLength = edgeLength;
  options.seed = seed;
  options.featureAngle = featureAngle;
  options.planarTolerance = PipelineOptions{}.tolerance;
  auto filled = fillDomain(prepared.value().domain, options);
  if (!filled.ok()) throw std::runtime_error(domain.name + ": " + filled.error().message);
  return std::move(filled.value().mesh);
}

/// For the first few failures of a certificate in a test's output.
inline std::string failuresOf(const Certificate &certificate) {
  std::string text;
  for (const CertificateFailure &f : certificate.failures)
    text += "\n  check " + std::to_string(static_cast<int>(f.check)) + ": " + f.message;
  return text;
}

template <int N> double minimumQuality(const PipelineResult<N> &result) {
  return result.quality.empty() ? 0 : *std::min_element(result.quality.begin(), result.quality.end());
}

/// A prism over a closed polygon given counter-clockwise, between two heights.
inline Domain<3> prism(const std::vector<Vec<2>> &polygon, double bottom, double top) {
  Domain<3> domain;
  domain.name = "prism";
  const Index n = toIndex(polygon.size());
  for (const double height : {bottom, top})
    for (const Vec<2> &p : polygon) domain.vertices.emplace_back(p.x, p.y, height);
  std::vector<Index> base;
  std::vector<Index> roof;
  for (Index k = 0; k < n; ++k) {
    base.insert(base.begin(), k);
    roof.push_back(n + k);
    const Index next = (k + 1) % n;
    domain.facets.push_back({{{k, next, n + next, n + k}}});
  }
  domain.facets.push_back({{base}});
  domain.facets.push_back({{roof}});
  return domain;
}

} // namespace dualblock::test
