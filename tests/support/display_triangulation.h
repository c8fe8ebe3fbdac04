// The paper's triangulations of the local dual contributions (4.1, figure 8), for display: each contribution
// is cut along its intersections with all others. Points are given by weights on the contribution's own
// corners, in units of 1 / kDisplayUnits. The corners are, in the paper's order:
//
//   face {n1, n2, n3}, opposite n4     q1, q2, q3 on the edges from n4 to n1, n2, n3
//   edge {n1, n2}, opposite n3, n4     r1, r2 near n1 towards n4, n3; r3, r4 near n2 towards n3, n4
//   node {n1}                          s1, s2, s3 on the edges from n1; it has no inner intersections
#pragma once

#include <array>

namespace dualblock::test {

inline constexpr int kDisplayUnits = 16;

template <std::size_t Corners, std::size_t Points, std::size_t Triangles> struct DisplayTriangulation {
  std::array<std::array<int, Corners>, Points> points;
  std::array<std::array<int, 3>, Triangles> triangles;
};

// clang-format off
//   0 1 2 q1 q2 q3, 3 4 q121 q122, 5 6 q231 q232, 7 8 q311 q312, 9 10 11 p1 p2 p3
inline constexpr DisplayTriangulation<3, 12, 13> kFaceDisplay{
    {{{16, 0, 0}, {0, 16, 0}, {0, 0, 16}, {12, 4, 0}, {4, 12, 0}, {0, 12, 4},
      {0, 4, 12}, {4, 0, 12}, {12, 0, 4}, {8, 4, 4}, {4, 8, 4}, {4, 4, 8}}},
    {{{0, 3, 8}, {1, 5, 4}, {2, 7, 6}, {3, 9, 8}, {5, 10, 4}, {7, 11, 6}, {3, 4, 10},
      {9, 3, 10}, {5, 6, 11}, {10, 5, 11}, {7, 8, 9}, {11, 7, 9}, {9, 10, 11}}}};

//   0 1 2 3 r1 r2 r3 r4, 4 5 r231 r232, 6 7 r411 r412, 8 r12, 9 r34
// The sixth triangle is {r412, r231, r411}; the paper prints {r412, r232, r411}, which overlaps the fifth.
inline constexpr DisplayTriangulation<4, 10, 10> kEdgeDisplay{
    {{{16, 0, 0, 0}, {0, 16, 0, 0}, {0, 0, 16, 0}, {0, 0, 0, 16}, {0, 12, 4, 0},
      {0, 4, 12, 0}, {4, 0, 0, 12}, {12, 0, 0, 4}, {7, 7, 1, 1}, {1, 1, 7, 7}}},
    {{{0, 1, 8}, {1, 4, 8}, {4, 7, 8}, {7, 0, 8}, {6, 4, 5},
      {7, 4, 6}, {2, 3, 9}, {3, 6, 9}, {6, 5, 9}, {5, 2, 9}}}};
inline constexpr std::size_t kEdgeDisplayCorrected = 5;                // of kEdgeDisplay.triangles
inline constexpr std::array<int, 3> kEdgeDisplayAsPrinted = {7, 5, 6}; // {r412, r232, r411}

inline constexpr DisplayTriangulation<3, 3, 1> kNodeDisplay{{{{16, 0, 0}, {0, 16, 0}, {0, 0, 16}}}, {{{0, 1, 2}}}};
// clang-format on

} // namespace dualblock::test
