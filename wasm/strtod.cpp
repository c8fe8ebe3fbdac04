// The C library's strtod reckons with quadruple precision in software, which is slow, and 6 kB (gzip) of the
// module. This one takes its place for both readers. Short numbers are exact in plain doubles (W. Clinger,
// "How to read floating point numbers accurately", 1990); what is left goes to JavaScript, which rounds
// correctly, too: every number comes out as natively, to the last bit.
#include <emscripten/val.h>

#include <array>
#include <cstdint>
#include <string>

namespace {

const char *skipDigits(const char *text) {
  while (*text >= '0' && *text <= '9') ++text;
  return text;
}

/// Whether both factors of digits times ten to the power e, and so the one rounding, are exact.
bool isShort(int digits, int e) { return digits <= 15 && e >= -22 && e <= 22; }

double scaled(std::uint64_t m, int e) {
  static constexpr std::array<double, 23> kTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const auto x = static_cast<double>(m);
  return e < 0 ? x / kTen[static_cast<std::size_t>(-e)] : x * kTen[static_cast<std::size_t>(e)];
}

} // namespace

/// Of a number in decimal notation, without space before it; `end` is where it ends, `text` if there is none.
extern "C" double strtod(const char *text, char **end) {
  const char *at = text;
  const bool isNegative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  std::uint64_t m = 0;
  int digits = 0; // from the first that is not zero
  int exponent = 0;
  bool any = false;
  for (bool fraction = false; (*at >= '0' && *at <= '9') || (*at == '.' && !fraction); ++at) {
    if (*at == '.') {
      fraction = true;
      continue;
    }
    any = true;
    if (m > 0 || *at != '0') ++digits;
    if (digits <= 15) m = 10 * m + static_cast<std::uint64_t>(*at - '0');
    exponent -= fraction ? 1 : 0;
  }
  *end = const_cast<char *>(any ? at : text);
  if (!any) return 0;
  if (*at == 'e' || *at == 'E') {
    const char *const sign = at + 1;
    const char *const first = sign + (*sign == '-' || *sign == '+' ? 1 : 0);
    const char *const last = skipDigits(first);
    if (last > first) {
      int power = 0; // of a million it is beyond all doubles in any case
      for (const char *d = first; d < last && power < 1'000'000; ++d) power = 10 * power + (*d - '0');
      exponent += *sign == '-' ? -power : power;
      *end = const_cast<char *>(last);
    }
  }
  if (isShort(digits, exponent)) return isNegative ? -scaled(m, exponent) : scaled(m, exponent);
  return emscripten::val::global("Number")(std::string(text, static_cast<const char *>(*end))).as<double>();
}

// libc++ asks for these, too, though nobody calls them: the C library has all three in one file.
extern "C" float strtof(const char *text, char **end) { return static_cast<float>(strtod(text, end)); }
extern "C" long double strtold(const char *text, char **end) { return strtod(text, end); }
