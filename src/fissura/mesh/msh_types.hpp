#pragma once
// The element types that stand in gmsh's mesh files.

namespace fissura::mesh {

/// gmsh's numbers of the element types this program knows.
enum MshElement { line_2 = 1, triangle_3 = 2, tet_4 = 4, point_1 = 15 };

struct MshType {
  int number, dimension, nodes;
  char const* name;
};
/// The types that gmsh writes for meshes of first to third order; lines of other types cannot be passed over
/// in a file of bytes.
inline constexpr MshType msh_types[] = {{1, 1, 2, "Line 2"},
                                        {2, 2, 3, "Triangle 3"},
                                        {3, 2, 4, "Quadrilateral 4"},
                                        {4, 3, 4, "Tetrahedron 4"},
                                        {5, 3, 8, "Hexahedron 8"},
                                        {6, 3, 6, "Prism 6"},
                                        {7, 3, 5, "Pyramid 5"},
                                        {8, 1, 3, "Line 3"},
                                        {9, 2, 6, "Triangle 6"},
                                        {10, 2, 9, "Quadrilateral 9"},
                                        {11, 3, 10, "Tetrahedron 10"},
                                        {12, 3, 27, "Hexahedron 27"},
                                        {13, 3, 18, "Prism 18"},
                                        {14, 3, 14, "Pyramid 14"},
                                        {15, 0, 1, "Point"},
                                        {16, 2, 8, "Quadrilateral 8"},
                                        {17, 3, 20, "Hexahedron 20"},
                                        {18, 3, 15, "Prism 15"},
                                        {19, 3, 13, "Pyramid 13"},
                                        {21, 2, 10, "Triangle 10"},
                                        {26, 1, 4, "Line 4"},
                                        {29, 3, 20, "Tetrahedron 20"},
                                        {36, 2, 16, "Quadrilateral 16"}};

} // namespace fissura::mesh
