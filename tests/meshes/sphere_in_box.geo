// Box "box" around a sphere "ball" of radius 0.5, each with a surface mesh of its own on the sphere, "slide". child = 1: with
// a cylinder "rotor" of radius 0.2 and height 0.1 in the ball, between them "rotor_slide".
// Each hole is made of two halves: gmsh would give shapes in the same place the same mesh.
DefineConstant[h_in = 0.12, h_out = 0.36, child = 0];
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
inner[] = Boundary{ Volume{5}; };
ball = 5;
If (child == 1)
  For half In {6 : 7}
    Cylinder(half) = {x, y, z, 0, 0.1, 0, 0.2, Pi};
  EndFor
  Rotate { {0, 1, 0}, {x, y, z}, Pi } { Volume{7}; }
  ball = 8;
  BooleanDifference(8) = { Volume{5}; Delete; }{ Volume{6, 7}; Delete; };
  inner[] = Boundary{ Volume{8}; };
  hole[] = Surface In BoundingBox {x - 0.3, y - 0.3, z - 0.3, x + 0.3, y + 0.3, z + 0.3};
  inner[] -= hole[];
  Cylinder(9) = {x, y, z, 0, 0.1, 0, 0.2};
  Rotate { {0, 1, 0}, {x, y, z}, 1 } { Volume{9}; }
  MeshSize{ PointsOf{ Volume{9}; } } = 0.05;
  rotor[] = Boundary{ Volume{9}; };
  Physical Volume("rotor") = {9};
  Physical Surface("rotor_slide") = {hole[], rotor[]};
EndIf
MeshSize{ PointsOf{ Volume{ball}; } } = h_in;
Physical Volume("ball") = {ball};
Physical Volume("box") = {4};
Physical Surface("far") = {far[]};
Physical Surface("slide") = {outer[], inner[]};
