// Box "box" around a sphere "ball" of radius 0.5, each with a surface mesh of its own on the sphere, "slide".
// The hole in the box is made of two halves: gmsh would give shapes in the same place the same mesh.
DefineConstant[h_in = 0.12, h_out = 0.36];
SetFactory("OpenCASCADE");
x = 0.1; y = 0.2; z = -0.1;
For half In {1 : 2}
  Sphere(half) = {x, y, z, 0.5, -Pi / 2, Pi / 2, Pi};
EndFor
Rotate { {0, 0, 1}, {x, y, z}, Pi } { Volume{2}; }
Box(3) = {-1, -1, -1, 2, 2, 2};
BooleanDifference(4) = { Volume{3}; Delete; }{ Volume{1, 2}; Delete; };
far[] = Boundary{ Volume{4}; };
outer[] = Surface In BoundingBox {-0.9, -0.9, -0.9, 0.9, 0.9, 0.9};
far[] -= outer[];
MeshSize{ PointsOf{ Volume{4}; } } = h_out;
Sphere(5) = {x, y, z, 0.5};
Rotate { {1, 1, 0}, {x, y, z}, 1 } { Volume{5}; }
MeshSize{ PointsOf{ Volume{5}; } } = h_in;
inner[] = Boundary{ Volume{5}; };
Physical Volume("ball") = {5};
Physical Volume("box") = {4};
Physical Surface("far") = {far[]};
Physical Surface("slide") = {outer[], inner[]};
