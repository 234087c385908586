SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 100, 100, 200};
Physical Volume("prism") = {1};
Mesh.MeshSizeMin = 22;
Mesh.MeshSizeMax = 22;
Mesh.Algorithm3D = 1;
