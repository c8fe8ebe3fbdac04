// Moving arrays between the core and JavaScript: one bulk copy each way, never a view of the heap.
#pragma once

#include <emscripten/val.h>

#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "base/types.h"

namespace dualblock {

using emscripten::val;

/// Any typed array or ArrayBuffer view, copied into a vector of the same element type.
template <typename T> std::vector<T> fromJs(const val &array) {
  std::vector<T> out(array["length"].as<std::size_t>());
  val(emscripten::typed_memory_view(out.size(), out.data())).call<void>("set", array);
  return out;
}

/// The same for vectors of points or arrays, whose scalars a flat typed array gives.
template <typename T, typename Scalar> std::vector<T> rowsFromJs(const val &array) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Scalar) == 0);
  std::vector<T> out(array["length"].as<std::size_t>() * sizeof(Scalar) / sizeof(T));
  auto *const data = reinterpret_cast<Scalar *>(out.data());
  val(emscripten::typed_memory_view(out.size() * (sizeof(T) / sizeof(Scalar)), data))
      .call<void>("set", array);
  return out;
}

/// A typed array that owns its memory. Vectors of points, arrays and enums become flat arrays of their
/// scalars.
template <typename Scalar, typename T> val toJs(const std::vector<T> &items) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Scalar) == 0);
  const auto *const data = reinterpret_cast<const Scalar *>(items.data());
  return val(emscripten::typed_memory_view(items.size() * (sizeof(T) / sizeof(Scalar)), data))
      .call<val>("slice");
}

/// A member of each item, as a typed array.
template <typename Scalar, typename T, typename Get> val column(const std::vector<T> &items, Get get) {
  std::vector<Scalar> values;
  values.reserve(items.size());
  for (const T &item : items) values.push_back(static_cast<Scalar>(get(item)));
  return toJs<Scalar>(values);
}

/// Several integers of each item, one item after the other.
template <std::size_t Width, typename T, typename Get> val rows(const std::vector<T> &items, Get get) {
  std::vector<std::array<Index, Width>> values;
  values.reserve(items.size());
  for (const T &item : items) values.push_back(get(item));
  return toJs<Index>(values);
}

inline val entitiesToJs(const std::vector<EntityRef> &entities) {
  val list = val::array();
  for (const EntityRef &e : entities) {
    val item = val::object();
    item.set("kind", e.kind);
    item.set("index", static_cast<double>(e.index));
    list.call<void>("push", item);
  }
  return list;
}

inline val stringsToJs(const std::vector<std::string> &strings) {
  val list = val::array();
  for (const std::string &s : strings) list.call<void>("push", s);
  return list;
}

/// {ok: false, error: {code, message, entities}}
inline val failure(const Error &error) {
  val e = val::object();
  e.set("code", std::string(errorCodeName(error.code)));
  e.set("message", error.message);
  e.set("entities", entitiesToJs(error.entities));
  val result = val::object();
  result.set("ok", false);
  result.set("error", e);
  return result;
}

/// Runs `work`, which returns a val; whatever it throws becomes a failure.
template <typename Work> val guarded(Work work) {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    return failure(
        {ErrorCode::outOfMemory, "There is not enough memory: refine less, or simplify the domain.", {}});
  } catch (const std::length_error &) {
    return failure(
        {ErrorCode::outOfMemory, "There is not enough memory: refine less, or simplify the domain.", {}});
  } catch (const std::exception &e) {
    return failure(
        {ErrorCode::internal, std::string("A defect in dualblock: ") + e.what() + ". Please report it.", {}});
  }
}

} // namespace dualblock
