// Checks that the tests of all readers of 3D text formats share.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "domain/domain.h"

namespace dualblock::test {

using Reader = std::function<Result<AnyDomain>(std::string_view)>;

/// The domain in a result; an empty one, and a failed test, if there is an error.
inline Domain<3> domainOf(const Result<AnyDomain> &result) {
  if (result.ok()) return std::get<Domain<3>>(result.value());
  ADD_FAILURE() << errorCodeName(result.error().code) << ": " << result.error().message;
  return {};
}

/// Whether an error names an entity.
inline bool names(const Error &error, const std::string &kind, std::int64_t index) {
  for (const EntityRef &entity : error.entities)
    if (entity.kind == kind && entity.index == index) return true;
  return false;
}

/// Expects an error with this code that names this line, in words and as an entity, and says what to do.
inline void expectRefusal(const Result<AnyDomain> &result, ErrorCode code, std::int64_t line,
                          const char *kind = "line", std::int64_t index = -1) {
  ASSERT_FALSE(result.ok()) << "expected " << errorCodeName(code);
  const Error &error = result.error();
  EXPECT_STREQ(errorCodeName(error.code), errorCodeName(code)) << error.message;
  EXPECT_EQ(error.message.rfind("Line " + std::to_string(line) + ": ", 0), 0U) << error.message;
  EXPECT_TRUE(names(error, "line", line)) << error.message;
  EXPECT_TRUE(names(error, kind, index < 0 ? line : index)) << error.message;
}

/// Whether a result is a value that later stages can index safely, or an error with a message.
inline bool isSound(const Result<AnyDomain> &result) {
  if (!result.ok()) return !result.error().message.empty() && !result.error().entities.empty();
  const auto &domain = std::get<Domain<3>>(result.value());
  for (const Facet &facet : domain.facets) {
    if (facet.loops.empty()) return false;
    for (const auto &loop : facet.loops) {
      if (loop.size() < 3) return false;
      for (const Index v : loop)
        if (v < 0 || at(v) >= domain.vertices.size()) return false;
    }
  }
  return !domain.vertices.empty() && !domain.facets.empty();
}

/// Reads every beginning of a text, and some hundred copies with wrong bytes, tokens or lines: no crash, and
/// sound results only. The same copies in every run.
inline void expectToSurviveDamage(const std::string &text, const Reader &read) {
  for (std::size_t size = 0; size < text.size(); size += 1 + text.size() / 400)
    EXPECT_TRUE(isSound(read(std::string_view(text).substr(0, size)))) << "the first " << size << " bytes";
  const std::string tokens[] = {"-1",
                                "0",
                                "2",
                                "99999999999999999999",
                                "-99999999999999999999",
                                "nan",
                                "-inf",
                                "1e999",
                                "1e308",
                                "#",
                                "\n",
                                "\r",
                                " ",
                                "x",
                                "1.5",
                                "+",
                                "0x1",
                                "4294967296",
                                "2147483647"};
  std::mt19937 random(7); // not a distribution's: those differ between standard libraries
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  for (int round = 0; round < 600; ++round) {
    std::string damaged = text;
    for (std::size_t k = 1 + below(3); k > 0; --k) {
      const std::size_t where = below(damaged.size());
      switch (below(4)) {
      case 0: damaged[where] = static_cast<char>(below(256)); break;
      case 1: damaged.erase(where, 1 + below(20)); break;
      case 2: damaged.insert(where, damaged.substr(below(damaged.size()), 1 + below(40))); break;
      default: damaged.replace(where, 1, " " + tokens[below(std::size(tokens))] + " ");
      }
      if (damaged.empty()) damaged = " ";
    }
    EXPECT_TRUE(isSound(read(damaged))) << "round " << round << ":\n" << damaged.substr(0, 2000);
  }
}

/// The folder of the surfaces made by others, or an empty path and a line of output.
inline std::filesystem::path sharedData() {
  const std::filesystem::path folder = std::filesystem::path(DUALBLOCK_SOURCE_DIR) / "../shared/data";
  if (std::filesystem::exists(folder / "PROVENANCE.tsv")) return folder;
  std::cout << "Skipped: there is no " << folder.string() << ".\n";
  return {};
}

inline std::string readFile(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Vertices at different places that facets use, and faces, as PROVENANCE.tsv counts them.
struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  bool operator==(const Counts &) const = default;
};

inline void PrintTo(const Counts &counts, std::ostream *out) {
  *out << counts.vertices << " vertices, " << counts.faces << " faces";
}

inline Counts countsOf(const Domain<3> &domain) {
  std::set<std::array<double, 3>> places;
  for (const Facet &facet : domain.facets)
    for (const auto &loop : facet.loops)
      for (const Index v : loop)
        places.insert({domain.vertices[at(v)].x, domain.vertices[at(v)].y, domain.vertices[at(v)].z});
  return {places.size(), domain.facets.size()};
}

/// The counts that PROVENANCE.tsv gives for a file, by its path from the shared folder.
inline Counts countsInProvenance(const std::filesystem::path &folder, const std::string &file) {
  std::ifstream table(folder / "PROVENANCE.tsv");
  for (std::string row; std::getline(table, row);) {
    std::istringstream columns(row);
    std::vector<std::string> column;
    for (std::string text; std::getline(columns, text, '\t');) column.push_back(text);
    if (column.size() > 6 && column[0] == file) return {std::stoul(column[5]), std::stoul(column[6])};
  }
  return {};
}

/// The shared files with an extension, as paths from the shared folder, in order.
inline std::set<std::string> sharedFiles(const std::filesystem::path &folder, const std::string &extension) {
  std::set<std::string> files;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension)
      files.insert(std::filesystem::relative(entry.path(), folder).generic_string());
  return files;
}

} // namespace dualblock::test
