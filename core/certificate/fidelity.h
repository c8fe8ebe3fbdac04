// How well straight faces stand for the bent sides that they approximate.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/types.h"

namespace dualblock {

// What a block mesh may differ by from its domain. A third of a turn is the most that one straight edge can
// stand for: its distance from an arc is then 0.29 of its length, and it still leads the way the arc does.
inline constexpr double kMostTurning = 120;      // degrees, of a curve along an edge, of a side in a face
inline constexpr double kMostDistance = 1.0 / 3; // of the face's or edge's own size
// Of what the blocks behind a face are thick. Beyond the first, parts are cut further where that serves: a
// wall whose sides are each a third of its thickness off has lost most of itself. Beyond the second, nothing
// of a wall need be left.
inline constexpr double kAimedDepth = 1.0 / 3;
inline constexpr double kMostDepth = 2.0 / 3;
// Of the domain's volume, between sides and faces, lost and gained alike: a ball of 32 blocks has 0.25.
inline constexpr double kMostStrayed = 0.3;

/// Of one bent side, by its patch, or of all of them (kNone).
struct SideFidelity {
  Index patch = kNone;
  double distance = 0; // the largest between faces and side, both ways, as a share of the face's size
  double depth = 0;    // the same as a share of how thick the blocks behind the face are
  double turning =
      0; // degrees: the largest angle between normals of the side within what one face stands for
  double strayed = 0; // volume between the side and its faces, on either side of it
};

/// A mesh's face on a bent side.
struct SideFace {
  std::array<Index, 4> nodes; // in a cycle
  Index patch;
  Index owner;   // block or element, for messages
  double column; // how thick the blocks are behind it, to the next facet
};

struct SideTriangle {
  std::array<Vec<3>, 3> corners;
  Index patch;
  Index facet = 0; // triangles in one plane may have one number: they are then looked at together
};

enum class Fault : std::uint8_t { distance, depth, turning };

struct FaceFault {
  Index face;
  double value; // of what is beyond its bound
  Fault kind;
};

struct SideMeasures {
  std::vector<SideFidelity> sides; // by patch
  std::vector<FaceFault> faults;   // faces beyond a bound, in their order
  std::vector<Index> furthest;     // faces with over half as much volume beside them as that with the most
  std::vector<Index> coarse;       // faces beyond what is aimed at, in their order
};

/// The longer of the lines through the middles of a face's opposite edges.
double faceSize(const std::vector<Vec<3>> &positions, const std::array<Index, 4> &nodes);

/// How a face strays from its side: the end of a message that has named both.
std::string describe(const FaceFault &fault);

/// Distances and turning between faces and sides. `samples`: points along each direction of a face, besides
/// its rim.
SideMeasures measureSides(const std::vector<Vec<3>> &positions, const std::vector<SideFace> &faces,
                          const std::vector<SideTriangle> &triangles, int samples);

/// Degrees that a chain of points turns by, in all: jags of single segments do not count where there are
/// many.
double turningOf(std::span<const Vec<3>> chain);

/// The largest distance between a chain and the segment between its ends, as a share of that segment.
double sagOf(std::span<const Vec<3>> chain);

} // namespace dualblock
