// tetgen.h with the switches that we never vary as constants: the code behind their other values is dead to
// the compiler, and no part of the module. They are put into class tetgenbehavior by way of the declaration
// of its method syntax(); tetgen_unit.cpp has TetGen's source read them instead of the variables.
#pragma once

/// Setting another value would silently be lost, hence throws, as TetGen's internal errors do.
template <int Value> struct FixedSwitch {
  constexpr operator int() const { return Value; }
  void operator=(int value) const {
    if (value != Value) throw 2;
  }
  void operator++(int) const {} // TetGen lowers and restores the verbosity; it only prints by it
  void operator--(int) const {}
};

// As after TetGen's parsing of "pYnnJQ" and of "pq1.414a<volume>nnJQ".
#define syntax()                                                                                             \
  syntax();                                                                                                  \
  static constexpr FixedSwitch<0> fixedPsc{}, fixedRefine{}, fixedCoarsen{}, fixedWeighted{},                \
      fixedIncrflip{}, fixedFlipinsert{}, fixedMetric{}, fixedVarvolume{}, fixedRegionattrib{},              \
      fixedInsertaddpoints{}, fixedDiagnose{}, fixedConvex{}, fixedNomergefacet{}, fixedNomergevertex{},     \
      fixedNoexact{}, fixedNostaticfilter{}, fixedZeroindex{}, fixedNobound{}, fixedReversetetori{},         \
      fixedVerbose{}, fixedNoSort{};                                                                         \
  static constexpr FixedSwitch<1> fixedBrioHilbert{}, fixedQuiet{}, fixedAddsteinerAlgo{},                   \
      fixedFliplinklevelinc{}, fixedDelmaxfliplevel{}, fixedOrder{};                                         \
  static constexpr FixedSwitch<2> fixedNeighout{}, fixedNobisectParam{}, fixedOptlevel{};                    \
  static constexpr FixedSwitch<3> fixedReflevel{};                                                           \
  static constexpr FixedSwitch<7> fixedOptscheme {}
#include "tetgen.h"
#undef syntax
