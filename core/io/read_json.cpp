#include "io/read_json.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/sort.h"
#include "io/refusal.h"
#include <nlohmann/json.hpp>

namespace dualblock {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(ErrorCode code, const std::string &message, std::vector<EntityRef> entities = {}) {
  throw Refusal{{code, message, std::move(entities)}};
}

/// Builds the tree of a JSON text, like the library's own builder, which brings filters by callback and
/// exceptions into the module.
struct TreeBuilder {
  Json &root;
  std::vector<Json *> open = {}; // arrays and objects that are not closed yet, outermost first
  Json *named = nullptr;         // of the innermost object, the member whose value follows
  std::size_t errorOffset = 0;   // bytes read up to where the text is no JSON
  std::string tooLarge = {};     // the number there that no double can hold, if that is the fault

  Json &put(Json value) {
    if (open.empty()) return root = std::move(value);
    if (open.back()->is_object()) return *named = std::move(value);
    open.back()->push_back(std::move(value));
    return open.back()->back();
  }
  bool add(Json value) {
    put(std::move(value));
    return true;
  }
  bool begin(Json value) {
    open.push_back(&put(std::move(value)));
    return true;
  }
  bool close() {
    open.pop_back();
    return true;
  }

  // What the parser calls.
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string &) { return add(value); }
  bool string(std::string &value) { return add(std::move(value)); }
  bool binary(Json::binary_t &) { return false; } // in no text
  bool start_object(std::size_t) { return begin(Json::object()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return begin(Json::array()); }
  bool end_array() { return close(); }
  bool key(std::string &name) {
    named = &(*open.back())[name];
    return true;
  }
  bool parse_error(std::size_t offset, const std::string &token, const Json::exception &problem) {
    errorOffset = offset;
    tooLarge = problem.id >= 200 ? token : ""; // not of a parse_error: a number that no double can hold
    return false;
  }
};

const Json &member(const Json &object, const char *key, const std::string &where) {
  const auto found = object.find(key);
  if (found == object.end()) refuse(ErrorCode::syntax, where + " has no \"" + key + "\".");
  return *found;
}

const Json &arrayOf(const Json &value, const std::string &where) {
  if (!value.is_array()) refuse(ErrorCode::syntax, where + " must be an array.");
  return value;
}

std::string textOf(const Json &object, const char *key) {
  const auto found = object.find(key);
  if (found == object.end()) return "";
  if (!found->is_string()) refuse(ErrorCode::syntax, std::string("\"") + key + "\" must be a string.");
  return found->get<std::string>();
}

template <int N>
Vec<N> pointOf(const Json &value, const std::string &where, const char *kind, std::size_t index) {
  const std::vector<EntityRef> entity{{kind, static_cast<std::int64_t>(index)}};
  if (!value.is_array() || value.size() != N)
    refuse(ErrorCode::syntax, where + " must be an array of " + std::to_string(N) + " numbers.", entity);
  Vec<N> point;
  for (int k = 0; k < N; ++k) {
    const Json &number = value[static_cast<std::size_t>(k)];
    if (number.is_null())
      refuse(ErrorCode::notFinite, where + " has a coordinate that is no finite number (null).", entity);
    if (!number.is_number()) refuse(ErrorCode::syntax, where + " must hold numbers only.", entity);
    point[k] = number.get<double>();
    if (!std::isfinite(point[k]))
      refuse(ErrorCode::notFinite, where + " has a coordinate that is not finite.", entity);
  }
  return point;
}

Index indexOf(const Json &value, std::size_t count, const std::string &where, const char *kind,
              std::size_t entity) {
  if (!value.is_number_integer()) refuse(ErrorCode::syntax, where + " must hold whole numbers.");
  const auto index = value.get<std::int64_t>();
  if (index < 0 || static_cast<std::size_t>(index) >= count)
    refuse(ErrorCode::indexOutOfRange,
           where + " names " + std::to_string(index) + ", but there are only 0 to " +
               std::to_string(static_cast<std::int64_t>(count) - 1) + ".",
           {{kind, static_cast<std::int64_t>(entity)}});
  return static_cast<Index>(index);
}

std::string item(const std::string &list, std::size_t k) { return list + "[" + std::to_string(k) + "]"; }

std::vector<Index> loopOf(const Json &value, std::size_t vertices, const std::string &where, const char *kind,
                          std::size_t entity) {
  std::vector<Index> loop;
  for (const Json &v : arrayOf(value, where)) loop.push_back(indexOf(v, vertices, where, kind, entity));
  return loop;
}

void readFacets(const Json &root, Domain<2> &domain) {
  const Json &loops = arrayOf(member(root, "loops", "the domain"), "\"loops\"");
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const auto loop = loopOf(loops[l], domain.vertices.size(), item("loops", l), "loop", l);
    if (loop.size() < 3)
      refuse(ErrorCode::tooFewVertices,
             item("loops", l) + " has " + std::to_string(loop.size()) + " vertices; a loop needs at least 3.",
             {{"loop", static_cast<std::int64_t>(l)}});
    for (std::size_t k = 0; k < loop.size(); ++k)
      domain.facets.push_back({{{loop[k], loop[(k + 1) % loop.size()]}}});
  }
}

void readFacets(const Json &root, Domain<3> &domain) {
  const Json &facets = arrayOf(member(root, "facets", "the domain"), "\"facets\"");
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const std::string where = item("facets", f);
    if (!facets[f].is_object()) refuse(ErrorCode::syntax, where + " must be an object with \"loops\".");
    const Json &loops = arrayOf(member(facets[f], "loops", where), where + ".loops");
    Facet facet;
    for (std::size_t l = 0; l < loops.size(); ++l)
      facet.loops.push_back(loopOf(loops[l], domain.vertices.size(), item(where + ".loops", l), "facet", f));
    if (facet.loops.empty())
      refuse(ErrorCode::degenerateFacet, where + " has no loop.", {{"facet", static_cast<std::int64_t>(f)}});
    domain.facets.push_back(std::move(facet));
  }
}

template <int N> void readReference(const Json &root, Domain<N> &domain) {
  const auto found = root.find("reference");
  if (found == root.end()) return;
  const Json &nodes = arrayOf(member(*found, "nodes", "\"reference\""), "reference.nodes");
  const Json &simplices = arrayOf(member(*found, "simplices", "\"reference\""), "reference.simplices");
  GivenReference<N> reference;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    reference.nodes.push_back(pointOf<N>(nodes[k], item("reference.nodes", k), "node", k));
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    const std::string where = item("reference.simplices", s);
    if (!simplices[s].is_array() || simplices[s].size() != N + 1)
      refuse(ErrorCode::syntax, where + " must be an array of " + std::to_string(N + 1) + " nodes.",
             {{"simplex", static_cast<std::int64_t>(s)}});
    std::array<Index, N + 1> simplex;
    for (std::size_t k = 0; k < simplex.size(); ++k)
      simplex[k] = indexOf(simplices[s][k], reference.nodes.size(), where, "simplex", s);
    reference.simplices.push_back(simplex);
  }
  if (reference.nodes.size() < domain.vertices.size())
    refuse(ErrorCode::referenceInvalid, "reference.nodes must begin with the domain's vertices.");
  for (std::size_t v = 0; v < domain.vertices.size(); ++v)
    if (reference.nodes[v] != domain.vertices[v])
      refuse(ErrorCode::referenceInvalid,
             item("reference.nodes", v) + " must be vertex " + std::to_string(v) + " of the domain.",
             {{"node", static_cast<std::int64_t>(v)}});
  domain.reference = std::move(reference);
}

void readContributions(const Json &root, Domain<2> &domain) {
  const auto found = root.find("contributions");
  if (found == root.end()) return;
  if (!domain.reference) refuse(ErrorCode::syntax, "\"contributions\" need a \"reference\" mesh.");
  const Json &list = arrayOf(*found, "\"contributions\"");
  std::set<std::pair<Index, std::vector<Index>>> given;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const std::string where = item("contributions", c);
    const std::string kind = textOf(list[c], "kind");
    if (kind != "hard" && kind != "soft")
      refuse(ErrorCode::contributionInvalid, where + ".kind must be \"hard\" or \"soft\".",
             {{"contribution", static_cast<std::int64_t>(c)}});
    GivenContribution contribution{kNone, {}, kind == "hard"};
    contribution.simplex = indexOf(member(list[c], "simplex", where), domain.reference->simplices.size(),
                                   where, "contribution", c);
    contribution.nodes = loopOf(member(list[c], "nodes", where), domain.reference->nodes.size(),
                                where + ".nodes", "contribution", c);
    const auto &simplex = domain.reference->simplices[at(contribution.simplex)];
    auto nodes = contribution.nodes;
    sortItems(nodes);
    bool proper = !nodes.empty() && nodes.size() < simplex.size() &&
                  std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
    for (const Index v : nodes) proper &= std::find(simplex.begin(), simplex.end(), v) != simplex.end();
    if (!proper)
      refuse(ErrorCode::contributionInvalid,
             where + ".nodes must name one or two different nodes of its simplex.",
             {{"contribution", static_cast<std::int64_t>(c)}});
    if (!given.insert({contribution.simplex, std::move(nodes)}).second)
      refuse(ErrorCode::contributionInvalid, where + " is in the list already: give each contribution once.",
             {{"contribution", static_cast<std::int64_t>(c)}});
    domain.contributions.push_back(std::move(contribution));
  }
}

template <int N> Domain<N> readDomain(const Json &root) {
  Domain<N> domain;
  domain.name = textOf(root, "name");
  domain.title = textOf(root, "title");
  domain.figure = textOf(root, "figure");
  const Json &vertices = arrayOf(member(root, "vertices", "the domain"), "\"vertices\"");
  for (std::size_t v = 0; v < vertices.size(); ++v)
    domain.vertices.push_back(pointOf<N>(vertices[v], item("vertices", v), "vertex", v));
  readFacets(root, domain);
  if (const auto holes = root.find("holes"); holes != root.end())
    for (std::size_t h = 0; h < arrayOf(*holes, "\"holes\"").size(); ++h)
      domain.holes.push_back(pointOf<N>((*holes)[h], item("holes", h), "hole", h));
  if (const auto regions = root.find("regions"); regions != root.end())
    for (std::size_t r = 0; r < arrayOf(*regions, "\"regions\"").size(); ++r) {
      const std::string where = item("regions", r);
      const Json &region = (*regions)[r];
      if (!region.is_object())
        refuse(ErrorCode::syntax, where + " must be an object with \"point\" and \"id\".");
      const Json &id = member(region, "id", where);
      const bool fits = id.is_number_integer() && id.get<std::int64_t>() == id.get<Index>();
      if (!fits) refuse(ErrorCode::syntax, where + ".id must be a whole number of at most nine digits.");
      domain.regions.push_back(
          {pointOf<N>(member(region, "point", where), where + ".point", "region", r), id.get<Index>()});
    }
  readReference(root, domain);
  if constexpr (N == 2) readContributions(root, domain);
  return domain;
}

Error notJson(std::string_view text, const TreeBuilder &tree) {
  const std::string_view read = text.substr(0, std::min(tree.errorOffset, text.size()));
  const std::int64_t line = 1 + std::count(read.begin(), read.end(), '\n');
  const std::size_t column = read.size() - (read.rfind('\n') + 1); // npos + 1 is 0
  const std::string where = "Line " + std::to_string(line) + ", column " + std::to_string(column) + ": ";
  if (!tree.tooLarge.empty())
    return {ErrorCode::notFinite,
            where + tree.tooLarge.substr(0, 40) +
                " is more than a double can hold. Give the number a finite value.",
            {{"line", line}}};
  if (tree.open.empty() && !tree.root.is_null())
    return {ErrorCode::syntax,
            where + "there is more text after the end of the domain. Remove it.",
            {{"line", line}}};
  if (tree.errorOffset >= text.size())
    return {ErrorCode::fileTruncated,
            where + "the JSON text ends too early; the file may be truncated.",
            {{"line", line}}};
  return {ErrorCode::syntax, where + "this is not JSON.", {{"line", line}}};
}

} // namespace

Result<AnyDomain> readJson(std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return Error{ErrorCode::fileEmpty, "The file is empty: it should hold a domain in JSON.", {{"line", 1}}};
  try {
    Json root;
    TreeBuilder tree{root};
    if (!Json::sax_parse(text, &tree)) return notJson(text, tree);
    if (!root.is_object()) refuse(ErrorCode::syntax, "A domain must be a JSON object.");
    const std::string format = textOf(root, "format");
    if (format.rfind("dualblock-domain/", 0) != 0)
      refuse(ErrorCode::syntax, "\"format\" must be \"dualblock-domain/1\".");
    if (format != "dualblock-domain/1")
      refuse(ErrorCode::versionUnknown,
             "\"" + format + "\" is a version this program does not know: it reads \"dualblock-domain/1\".");
    const Json &given = member(root, "dimension", "the domain");
    const double dimension = given.is_number() ? given.get<double>() : 0;
    if (dimension == 2) return AnyDomain(readDomain<2>(root));
    if (dimension == 3) return AnyDomain(readDomain<3>(root));
    refuse(ErrorCode::syntax, "\"dimension\" must be 2 or 3.");
  } catch (const Refusal &refusal) {
    return refusal.error;
  } catch (const Json::exception &e) {
    return Error{ErrorCode::syntax, std::string("The domain is not well formed: ") + e.what(), {}};
  }
}

} // namespace dualblock
