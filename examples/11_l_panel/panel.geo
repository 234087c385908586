// Winkler's L-panel, half its thickness (y from the middle to the side), in mm: triangles drawn out to tets.
// 20 mm where the crack may run, 40 mm elsewhere.
fine = 20;  coarse = 40;  layers = 2;
Point(1) = {0, 0, 0};      Point(2) = {250, 0, 0};
Point(3) = {250, 0, 250};  Point(4) = {470, 0, 250};  // corner; load
Point(5) = {500, 0, 250};  Point(6) = {500, 0, 500};
Point(7) = {0, 0, 500};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
out[] = Extrude {0, 50, 0} { Surface{1}; Layers{layers}; };
Physical Volume("panel") = {out[1]};

Field[1] = Box;
Field[1].VIn = fine;  Field[1].VOut = coarse;
Field[1].XMin = -1;   Field[1].XMax = 270;
Field[1].YMin = -1;   Field[1].YMax = 101;
Field[1].ZMin = 230;  Field[1].ZMax = 380;
Field[1].Thickness = 100;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 1;   // MeshAdapt: no straight rows of triangles that a crack could follow
