// Every number that finding parts was tuned by, with its unit and its reason. What is no choice, as the ideal
// angles of the paper's 2.4, stands where it is used.
#pragma once

#include <cstddef>
#include <numbers>

#include "base/types.h"

namespace dualblock {

inline constexpr double kDegree = std::numbers::pi / 180;

// --- Which curves are cut, and along which planes (rule 1)

// Curves of more than kFlatAngle are cut; where blocks of flatter ones are tried, those of more than this.
inline constexpr double kNearlyFlatAngle = 178 * std::numbers::pi / 180;
// A plane may turn by so much from its sector's place to serve another curve, too.
inline constexpr double kSnap = std::numbers::pi / 8;
// The sectors beside a plane that turns keep angles between these.
inline constexpr double kLeastSector = std::numbers::pi / 4;
inline constexpr double kMostSector = 3 * std::numbers::pi / 4;
// Directions of planes that count as the same, and that nearly do; radians.
inline constexpr double kSameDirection = 1e-7;
inline constexpr double kNearDirection = 0.1;
// A ridge has been cut along a plane that differs by less: nodes count as in a plane by 1e-6 of the size.
inline constexpr double kCutAlready = 1e-6;
// Angles along a run that differ by less do so by the facets of a bent side.
inline constexpr double kSameAlongRun = std::numbers::pi / 18;
inline constexpr int kReflexRounds = 4;

// --- Sheets and dishes in place of planes at closed curves

// Directions to one curve differ by less along another that a sheet can lead to.
inline constexpr double kSteadyHeading = std::numbers::pi / 18;
inline constexpr int kHeadingPasses = 2; // of smoothing: facets of bent sides tilt
inline constexpr double kSheetTurn = std::numbers::pi / 8;
inline constexpr double kLeastDishCosine = 0.4; // between a dish's beginning and its plane: it is nearly one
inline constexpr double kDishDepth = 0.5;       // of the curve's radius
// Of an edge's length: how far a surface may be off it. Sheets may be crossed at any angle; dishes are
// crossed steeply, where a fold would be crossed twice.
inline constexpr double kSheetSagitta = 0.2;
inline constexpr double kDishSagitta = 0.05;

// --- Closed curves, and the axes that they turn around

inline constexpr double kCircle = 1e-4;          // of the radius: a chain is a circle that is off by less
inline constexpr double kArc = 0.01;             // the same of an arc, whose nodes cuts have moved
inline constexpr double kSameAxisCosine = 0.998; // axes of chains with cuts' nodes beside the circle
inline constexpr double kSameAxisPlace = 0.05;   // of the radius
inline constexpr double kOnAxis = 1e-6;          // of the domain's size: nearer than this is on the axis
inline constexpr double kPrincipal = 0.01;       // of second moments: planes that divide a chain evenly
inline constexpr std::size_t kAxisPlanes = 8;    // through one axis that are tried, best first
// A plane gives way to a plain one: cosine of 2e-4, and its distance as a share of the domain's size.
inline constexpr double kPlainCosine = 1 - 2e-8;
inline constexpr double kPlainDistance = 1e-4;

// --- Bent sides (rule 3)

inline constexpr double kMostLean =
    70 * kDegree; // of a side's normals from their mean: a half cylinder's do by 90
inline constexpr double kHollowLean = 30 * kDegree; // where hollow sides count
inline constexpr double kNearMiddle = 37 * kDegree; // corners that are this near to the middle attract a cut
inline constexpr double kMostCurveTurn = 240 * kDegree; // of a curve, whose halves get an edge each
inline constexpr double kLeastCurveTurn = 5 * kDegree;  // of a curve that is worth halving
inline constexpr std::size_t kManyNodes =
    16; // of a chain: its turns count over several nodes, as cuts leave jags
inline constexpr std::size_t kLeastCrease = 4; // nodes: slivers of a coarse tessellation have fewer
inline constexpr double kFlatCrease = 1e-5;    // of the domain's size, off its plane
inline constexpr double kMirrored = 1e-6;      // of the domain's size: chains that are mirror images
inline constexpr double kLikeCosine = 0.95; // a plane through an axis in place of one midway between chains
inline constexpr std::size_t kProposalsAlone = 6; // of one part that is halved, each judged by itself
inline constexpr std::size_t kMostSpread = 8;     // parts that such a cut may add
inline constexpr int kBentRounds = 1000;          // cuts; it is simplices that end them
// Cuts for shape that make more than so many times as many parts as there were, or bent sides, and so many
// more, are taken back.
inline constexpr std::size_t kMoreParts = 3;
inline constexpr std::size_t kFewMoreParts = 6;

// --- Joints: corners of too many sides, sides unlike those behind them

inline constexpr Index kCrowdedWeight = 3;   // per side too many: each needs a cut of its own
inline constexpr Index kUnlikeWeight = 2;    // per corner: they come in pairs, of which one cut cures both
inline constexpr Index kTornWeight = 3;      // per part
inline constexpr Index kJointTrials = 60;    // cuts that are tried
inline constexpr Index kJointWork = 2000000; // simplices that they may go through in all: 2 s
inline constexpr Index kJointDetour = 3;     // of cost: how much worse a cut may be that others mend
inline constexpr double kSameJoint = 1e-2;   // sine between curves that give no plane
inline constexpr double kSameJointCosine = 1e-5;

// --- Corners of too many sides (rule 2)

inline constexpr int kVertexRounds = 40;

// --- What cuts may cost

// Simplices that a component may come to: so many times as many as it has, and some.
inline constexpr Index kTimesSimplices = 40;
inline constexpr Index kMoreSimplices = 60000;
inline constexpr Index kMoreTriangles = 200000; // cheap
inline constexpr double kBentShare = 0.2;       // of that: bent cuts are dear, and those that help come early
// Counted again when there are so many times as many: often enough to stop in time, seldom enough to be
// cheap.
inline constexpr double kRecount = 1.25;
inline constexpr Index kCheap = 10000;        // simplices, up to which other policies are tried
inline constexpr Index kCheapToHalve = 60000; // up to which parts that do not serve are halved
inline constexpr int kHalvings = 8;           // rounds of that
inline constexpr int kHalvedAlone = 40;       // cuts of single parts that are tried in all of them
// The same where fewer parts are halved at a time: that ends where no fewer blocks are inverted afterwards.
inline constexpr Index kCheapToHalveFewer = 120000;
inline constexpr int kFewerAlone = 200;
inline constexpr int kBlameRounds = 4; // of components that are blamed one by one; then all fall back

// --- Blocks that stray from bent sides: D-bar-surfaces doubled

inline constexpr int kDoublings = 4;        // rounds
inline constexpr int kPutRounds = 8;        // of nodes that go onto their sides as far as blocks stay valid
inline constexpr int kPutHalvings = 5;      // of their way there
inline constexpr int kPutSweeps = 3;        // of relaxation between rounds
inline constexpr double kPutShape = 0.02;   // scaled Jacobian that they may go down to
inline constexpr std::size_t kStraying = 3; // meshes that stray, of which one may be doubled

// --- Which parts are better

// Scaled Jacobian: with less, other choices of parts are tried, and no finer mesh is taken for a closer one.
inline constexpr double kPoorShape = 0.1;
inline constexpr double kNearBound = 0.8; // of what the domain's angles allow: nothing much better can come
inline constexpr double kMuchBetter = 3;  // times the scaled Jacobian, though that stays poor
// Times the blocks that good simplices may cost where the shape is poor, and where blocks are mere needles.
inline constexpr double kTimesForShape = 12;
inline constexpr double kTimesForNeedles = 100;
inline constexpr double kNeedle = 0.02;
// Coarsest meshes of fewer simplices are tried first: they may do.
inline constexpr Index kFewSimplices = 250;
inline constexpr double kGoodSine =
    0.17; // of 10 and 170 degrees: what is less distorted needs no more blocks
inline constexpr double kWorseSine = 0.5; // of the others' worst sine: what fewer blocks may cost
inline constexpr double kSameSine = 1e-9;
// Of the worst scaled Jacobian: what has to be left of it in other places for them not to be a makeshift.
inline constexpr double kKeptShape = 0.7;

// --- Good simplices (remesh/). Shapes: 1 for a regular tetrahedron, 0 for a flat one. Lengths of edges are
// shares of the size wanted where they are.

inline constexpr double kLargestTriangle = 0.3;   // of the domain's size: larger ones save nothing
inline constexpr double kSmallestTriangle = 1e-3; // of the domain's size: finer details are not followed
inline constexpr double kPerRadius = 0.52;        // of a radius: 12 edges to a turn
inline constexpr double kPerThickness = 1.2;      // two layers or three across a wall
inline constexpr double kInWedge = 0.35;   // of the distance of a wedge's edge, where it is thin by itself
inline constexpr double kAtWedge = 0.5;    // of the size of that edge
inline constexpr double kPerGap = 1;       // of the distance of two curves that do not meet
inline constexpr double kLeastTurn = 0.02; // radians: less is how a tessellation is rounded
inline constexpr double kSizeGrowth = 0.4; // of a size along a length of 1
// Edges longer than the first are divided, shorter than the second contracted: halves of the longest are no
// shorter.
inline constexpr double kLongEdge = 1.4;
inline constexpr double kShortEdge = 0.7;
// Where there are more tetrahedra than aimed at, all sizes grow by this factor after each round.
inline constexpr Index kMostTets = 1500;
inline constexpr double kCoarser = 1.15;
inline constexpr Index kTimesMost = 8; // so many times more may there be on the way: the coarsest are long
inline constexpr double kFittingCosine = 0.7;  // between a face on a bent side and that, 45 degrees
inline constexpr double kFittingSagitta = 0.1; // of the shortest edge: blocks' faces are a third of it
inline constexpr double kKeptBySplit = 1e-3;   // of a shape, by each half, where the middle moves onto a side
inline constexpr double kShapeOfContracted = 0.1; // that an edge may be contracted to
inline constexpr double kLeastGain = 1e-3;        // of shape, for an edit to be worth it
inline constexpr double kPoorTet = 0.35;          // below it is worth trials that may be taken back
inline constexpr double kGoodShape = 0.5;         // beyond, blocks are no better for more
inline constexpr double kUsefulShape =
    0.02; // of good simplices: what is worse is not worth thousands of blocks
inline constexpr double kSoundShape = 0.25; // of coarsest tetrahedra that may stay as they are
inline constexpr int kGoodAttempts = 2;
inline constexpr double kFinerAttempt = 0.7; // of the sizes before
inline constexpr int kSizePasses = 5;        // most is done after three
inline constexpr int kShapePasses = 10;      // it mostly ends by itself after five
inline constexpr int kDivideRounds = 10;
inline constexpr int kSwapRounds = 6;
inline constexpr int kSmoothRounds = 3;
inline constexpr int kGradeRounds = 20;

} // namespace dualblock
