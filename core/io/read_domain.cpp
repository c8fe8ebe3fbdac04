#include "io/read_domain.h"

#include "io/read_json.h"
#include "io/read_off.h"
#include "io/read_poly.h"

namespace dualblock {

Result<AnyDomain> readDomain(std::string_view format, std::string_view text) {
  if (format == "json") return readJson(text);
  if (format == "off") return readOff(text);
  if (format == "poly" || format == "smesh") return readPoly(text, format == "smesh");
  return Error{
      ErrorCode::formatUnknown,
      "\"" + std::string(format.substr(0, 24)) +
          "\" is no format that domains are read from. Convert the file to json, off, poly or smesh.",
      {}};
}

} // namespace dualblock
