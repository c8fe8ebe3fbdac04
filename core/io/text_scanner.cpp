#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace dualblock {
namespace {

constexpr std::string_view kBlank = " \t\v\f";

/// A token as a message shows it: short, and printable whatever the file holds.
std::string quoted(std::string_view token) {
  constexpr std::size_t kShown = 24;
  std::string shown = "\"";
  for (const char c : token.substr(0, kShown)) shown += c > ' ' && c < '\x7f' ? c : '?';
  return shown + (token.size() > kShown ? "...\"" : "\"");
}

/// "nan", "-inf", "Infinity", "nan(0x1)" and Microsoft's "1.#INF": what programs print for no finite number.
bool namesNoFiniteNumber(std::string_view token) {
  if (token.find('#') != std::string_view::npos) return true;
  if (token[0] == '-' || token[0] == '+') token.remove_prefix(1);
  std::string lower(token.substr(0, 9));
  for (char &c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.rfind("nan", 0) == 0 || lower == "inf" || lower == "infinity";
}

/// Where a line's comment begins. The '#' of "1.#INF" begins none: z = "1." would be a silent misreading.
std::size_t commentStart(std::string_view line) {
  std::size_t at = line.find('#');
  while (at != std::string_view::npos && at > 0 && line[at - 1] == '.' && at + 1 < line.size() &&
         std::string_view("IQS").find(line[at + 1]) != std::string_view::npos)
    at = line.find('#', at + 1);
  return at;
}

/// Parses a whole token in decimal notation. strtod, as libc++ 13 has no from_chars for double.
bool parseNumber(std::string_view token, double &value) {
  std::array<char, 512> copy; // %f of the largest double takes 317 characters
  if (token.size() >= copy.size()) return false;
  if (token.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return false; // no hexadecimal
  std::copy(token.begin(), token.end(), copy.begin());
  copy[token.size()] = '\0';
  char *end = nullptr;
  value = std::strtod(copy.data(), &end);
  if (*end == '.') { // the program's user has set a locale with a decimal comma
    *end = *std::localeconv()->decimal_point;
    value = std::strtod(copy.data(), &end);
  }
  return end == copy.data() + token.size();
}

} // namespace

TextScanner::TextScanner(std::string_view text) : text_(text) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3); // UTF-8's byte order mark
}

void TextScanner::begin(const char *kind, Index index) {
  kind_ = kind;
  index_ = index;
}

bool TextScanner::nextLine() {
  while (next_ < text_.size()) {
    const std::size_t stop = std::min(text_.find_first_of("\r\n", next_), text_.size());
    rest_ = text_.substr(next_, stop - next_);
    next_ = stop + (text_.substr(stop, 2) == "\r\n" ? 2 : 1);
    ++line_;
    rest_ = rest_.substr(0, commentStart(rest_));
    if (lineIsDone()) continue;
    anyLine_ = true;
    return true;
  }
  return false;
}

void TextScanner::needLine(const std::string &what) {
  if (nextLine()) return;
  line_ = std::max<std::int64_t>(line_, 1);
  if (!anyLine_) refuse(ErrorCode::fileEmpty, "the file is empty: it should hold " + what + ".");
  refuse(ErrorCode::fileTruncated,
         "the file ends where " + what + " should follow. Get the whole file, or add what is missing.");
}

void TextScanner::needEntry(const char *what, Index done, Index total) {
  if (nextLine()) return;
  refuse(ErrorCode::fileTruncated, "the file ends after " + std::to_string(done) + " of the " +
                                       std::to_string(total) + " announced entries for " + what +
                                       ". Get the whole file, or correct the count.");
}

void TextScanner::needEnd(const char *what) {
  if (nextLine())
    refuse(ErrorCode::syntax,
           std::string("there is more text after the last ") + what +
               " that was announced. Correct the counts, or remove what does not belong here.");
}

bool TextScanner::lineIsDone() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
  return rest_.empty();
}

std::string_view TextScanner::token(const char *what) {
  if (lineIsDone()) {
    if (next_ > text_.size()) // not even a line end follows
      refuse(ErrorCode::fileTruncated,
             std::string("the file ends where ") + what + " should follow. Get the whole file.");
    refuse(ErrorCode::syntax, std::string("the line ends where ") + what + " should follow. Add it.");
  }
  const std::string_view found = rest_.substr(0, rest_.find_first_of(kBlank));
  rest_.remove_prefix(found.size());
  return found;
}

std::int64_t TextScanner::integer(const char *what) {
  const std::string_view found = token(what);
  const std::string_view digits = found.substr(found[0] == '+' ? 1 : 0); // from_chars knows no '+'
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (problem == std::errc::invalid_argument || end != digits.data() + digits.size())
    refuse(ErrorCode::syntax,
           quoted(found) + " stands where " + what + " should: a whole number. Correct the line.");
  if (problem == std::errc::result_out_of_range)
    value = digits[0] == '-' ? std::numeric_limits<std::int64_t>::min()
                             : std::numeric_limits<std::int64_t>::max();
  return value;
}

Index TextScanner::count(const char *what) {
  const std::int64_t value = integer(what);
  if (value < 0)
    refuse(ErrorCode::syntax,
           std::string(what) + " is negative (" + std::to_string(value) + "). Correct it.");
  const std::size_t limit = std::min(text_.size(), at(std::numeric_limits<Index>::max()));
  if (static_cast<std::uint64_t>(value) > limit)
    refuse(ErrorCode::syntax, std::string(what) + " is " + std::to_string(value) + ", more than a file of " +
                                  std::to_string(text_.size()) +
                                  " bytes can hold. Correct it, or get the whole file.");
  return static_cast<Index>(value);
}

double TextScanner::number(const char *what) {
  const std::string_view found = token(what);
  double value = 0;
  if (!parseNumber(found, value) && !namesNoFiniteNumber(found))
    refuse(ErrorCode::syntax,
           quoted(found) + " stands where " + what +
               " should: a number with a decimal point, like -1.5 or 2e-3. Correct the line.");
  if (namesNoFiniteNumber(found) || !std::isfinite(value))
    refuse(ErrorCode::notFinite,
           quoted(found) + " stands where " + what +
               " should, and is no finite number. Give it a value that a double can hold.");
  return value;
}

Vec<3> TextScanner::point(const char *what) {
  Vec<3> x;
  for (int k = 0; k < 3; ++k) x[k] = number(what);
  return x;
}

Index TextScanner::vertexIndex(std::int64_t first, std::size_t size) {
  const std::int64_t value = integer("the number of a vertex");
  const std::int64_t last = first + static_cast<std::int64_t>(size) - 1;
  if (value < first || value > last)
    refuse(ErrorCode::indexOutOfRange, "vertex " + std::to_string(value) +
                                           " is named, but there are only vertices " + std::to_string(first) +
                                           " to " + std::to_string(last) +
                                           ". Correct the number, or add the vertex.");
  return static_cast<Index>(value - first);
}

void TextScanner::needText() const {
  std::int64_t line = 1;
  for (std::size_t k = 0; k < text_.size(); ++k) {
    const char c = text_[k];
    if (c == '\n' || (c == '\r' && text_.substr(k, 2) != "\r\n")) ++line;
    const bool control = (c >= '\0' && c < ' ' && !(c >= '\t' && c <= '\r')) || c == '\x7f';
    if (control)
      throw Refusal{{ErrorCode::syntax,
                     "Line " + std::to_string(line) +
                         ": a byte that belongs to no text: the file is binary, damaged" +
                         " or in UTF-16. Save it as plain text.",
                     {{"line", line}}}};
  }
}

void TextScanner::refuse(ErrorCode code, const std::string &message) const {
  std::vector<EntityRef> entities;
  if (kind_ != nullptr) entities.push_back({kind_, index_});
  entities.push_back({"line", line_});
  throw Refusal{{code, "Line " + std::to_string(line_) + ": " + message, std::move(entities)}};
}

} // namespace dualblock
