// Quarter of the beam of example 4.2 (x from the end to midspan, y from the side to the middle), unstructured.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2.25, 0.075, 0.25};
// Lines of support and load lie on the surface as mesh edges.
Point(101) = {0.25, 0, 0};     Point(102) = {0.25, 0.075, 0};
Point(103) = {1.5, 0, 0.25};   Point(104) = {1.5, 0.075, 0.25};
Line(101) = {101, 102};
Line(102) = {103, 104};
BooleanFragments{ Volume{1}; Delete; }{ Line{101, 102}; Delete; }
Physical Volume("beam") = {1};
Mesh.MeshSizeMin = 0.03;
Mesh.MeshSizeMax = 0.03;
Mesh.Algorithm3D = 1;
