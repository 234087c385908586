// The notched beam in mm, triangles drawn out to tets: 12 mm around the ligament, 60 mm at the ends; a slot of 10 mm for the notch.
fine = 12;  coarse = 60;
Point(1) = {0, 0, 0, coarse};       Point(2) = {995, 0, 0, coarse};
Point(3) = {995, 0, 100, fine};     Point(4) = {1005, 0, 100, fine};
Point(5) = {1005, 0, 0, coarse};    Point(6) = {2000, 0, 0, coarse};
Point(7) = {2000, 0, 200, coarse};  Point(8) = {1000, 0, 200, fine};
Point(9) = {0, 0, 200, coarse};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};
Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 9};  Line(9) = {9, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8, 9};
Plane Surface(1) = {1};
out[] = Extrude {0, 50, 0} { Surface{1}; Layers{1}; };
Physical Volume("beam") = {out[1]};

Field[1] = Box;
Field[1].VIn = fine;  Field[1].VOut = coarse;
Field[1].XMin = 950;  Field[1].XMax = 1050;
Field[1].YMin = -1;   Field[1].YMax = 51;
Field[1].ZMin = 90;   Field[1].ZMax = 201;
Field[1].Thickness = 300;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 1;   // MeshAdapt: no straight rows of triangles that a crack could follow
