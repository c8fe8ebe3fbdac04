// What the readers of line-based text formats share: lines, tokens, numbers, and the errors in them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/types.h"
#include "io/refusal.h"

namespace dualblock {

/// Walks through a text line by line and, within a line, token by token. '#' begins a comment; lines that
/// hold nothing else are skipped. Lines end in LF, CRLF or CR. Every failure is thrown as a Refusal that
/// names the line and, after begin(), the entity being read. All work is linear in the text, which must
/// outlive this.
class TextScanner {
public:
  explicit TextScanner(std::string_view text);

  /// Names what the next lines describe, for the entities of errors: a kind as in EntityRef, zero-based.
  void begin(const char *kind, Index index);
  /// Errors no longer belong to an entity.
  void end() { kind_ = nullptr; }

  /// Goes to the next line that holds a token; false at the end of the text.
  bool nextLine();
  /// nextLine, where `what` must follow. Errors: fileEmpty, fileTruncated.
  void needLine(const std::string &what);
  /// nextLine, where entry `done` (from zero) of `total` must follow. Errors: fileTruncated.
  void needEntry(const char *what, Index done, Index total);
  /// Nothing but comments may follow. Errors: syntax.
  void needEnd(const char *what);

  /// One-based number of the current line.
  std::int64_t line() const { return line_; }
  /// Whether the current line has no further token.
  bool lineIsDone();

  /// The next token of the current line. Errors: syntax, fileTruncated where the text ends in this line.
  std::string_view token(const char *what);
  /// A whole number, clamped to 64 bits. Errors: those of token; syntax.
  std::int64_t integer(const char *what);
  /// A whole number that may count things in this text: not negative, and no larger than the text has bytes,
  /// so that a wrong count cannot cause a huge allocation. Errors: those of integer; syntax.
  Index count(const char *what);
  /// A number in decimal notation. Errors: those of token; syntax, notFinite.
  double number(const char *what);
  /// Three numbers. Errors: those of number.
  Vec<3> point(const char *what);
  /// A reference to one of `size` vertices that are numbered from `first`, as a zero-based index.
  /// Errors: those of integer; indexOutOfRange.
  Index vertexIndex(std::int64_t first, std::size_t size);

  /// Refuses a text that holds control characters or zero bytes: it is binary or UTF-16. Errors: syntax.
  void needText() const;

  /// Throws an error about the current line and entity.
  [[noreturn]] void refuse(ErrorCode code, const std::string &message) const;

private:
  std::string_view text_;
  std::size_t next_ = 0;  // where the next line begins
  std::string_view rest_; // of the current line, its comment cut off
  std::int64_t line_ = 0; // of the current line; 0 before the first
  bool anyLine_ = false;  // a line with a token has been found
  const char *kind_ = nullptr;
  Index index_ = 0;
};

} // namespace dualblock
