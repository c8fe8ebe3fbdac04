#include "support/examples.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "io/read_json.h"

namespace dualblock::test {

std::string readText(const std::string &path) {
  std::ifstream file(std::string(DUALBLOCK_SOURCE_DIR) + "/" + path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

AnyDomain loadExample(const std::string &name) {
  auto read = readJson(readText("public/examples/" + name + ".json"));
  if (!read.ok()) throw std::runtime_error(name + ": " + read.error().message);
  return std::move(read.value());
}

std::vector<std::string> exampleNames() {
  std::vector<std::string> names;
  const auto index = nlohmann::json::parse(readText("public/examples/index.json"));
  for (const auto &example : index.at("examples")) names.push_back(example.at("name").get<std::string>());
  return names;
}

std::vector<std::string> computedExampleNames() {
  std::vector<std::string> names;
  for (const std::string &name : exampleNames())
    if (readText("public/examples/" + name + ".json").find("\"contributions\"") == std::string::npos)
      names.push_back(name); // every process that runs a test asks for them: they are not read for that
  return names;
}

template <int N> PipelineResult<N> run(const Domain<N> &domain, const PipelineOptions &options) {
  auto result = runPipeline<N>(domain, options);
  if (!result.ok()) throw std::runtime_error(domain.name + ": " + result.error().message);
  return std::move(result.value());
}

template <int N>
ReferenceMesh<N> fill(const Domain<N> &domain, double edgeLength, std::uint32_t seed, double featureAngle) {
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

std::string failuresOf(const Certificate &certificate) {
  std::string text;
  for (const CertificateFailure &f : certificate.failures)
    text += "\n  check " + std::to_string(static_cast<int>(f.check)) + ": " + f.message;
  return text;
}

Domain<3> prism(const std::vector<Vec<2>> &polygon, double bottom, double top) {
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

template PipelineResult<2> run(const Domain<2> &, const PipelineOptions &);
template PipelineResult<3> run(const Domain<3> &, const PipelineOptions &);
template ReferenceMesh<2> fill(const Domain<2> &, double, std::uint32_t, double);
template ReferenceMesh<3> fill(const Domain<3> &, double, std::uint32_t, double);

} // namespace dualblock::test
