// A certificate as a JavaScript object.
#pragma once

#include "certificate/certificate.h"
#include "marshal.h"

namespace dualblock {

inline constexpr const char *kCheckNames[] = {"matching", "cells", "topology", "geometry", "features"};

inline val fidelityToJs(const Fidelity &fidelity) {
  val f = val::object();
  f.set("largestDistance", fidelity.largestDistance);
  f.set("largestDepth", fidelity.largestDepth);
  f.set("largestTurning", fidelity.largestTurning);
  f.set("volumeDifference", fidelity.volumeDifference);
  f.set("strayedVolume", fidelity.strayed);
  val sides = val::array();
  for (const SideFidelity &side : fidelity.sides) {
    val s = val::object();
    s.set("facet", side.patch);
    s.set("distance", side.distance);
    s.set("depth", side.depth);
    s.set("turning", side.turning);
    sides.call<void>("push", s);
  }
  f.set("sides", sides);
  return f;
}

/// `from`, `to`: the checks that were made, by Check; the others are null.
inline val certificateToJs(const Certificate &certificate, std::size_t from, std::size_t to) {
  val c = val::object();
  for (std::size_t k = 0; k < std::size(kCheckNames); ++k)
    c.set(kCheckNames[k], k < from || k >= to ? val::null() : val(bool{certificate.passed[k]}));
  c.set("valid", certificate.valid);
  val failures = val::array();
  for (const CertificateFailure &f : certificate.failures) {
    val item = val::object();
    item.set("check", std::string(kCheckNames[static_cast<std::size_t>(f.check)]));
    item.set("message", f.message);
    item.set("entities", entitiesToJs(f.entities));
    failures.call<void>("push", item);
  }
  c.set("failures", failures);
  c.set("domainMeasure", certificate.domainMeasure);
  c.set("meshMeasure", certificate.meshMeasure);
  c.set("worstCoefficient", certificate.worstCoefficient);
  c.set("isExact", certificate.isExact);
  c.set("fidelity", fidelityToJs(certificate.fidelity));
  return c;
}

} // namespace dualblock
