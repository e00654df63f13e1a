// Ball "ball" of radius 2 around a cylinder "rotor" of radius 0.6 and height 0.5; both volumes have surface meshes of their
// own on the cylinder, "slide". The cylinder's axis is tilted and off the origin. layers > 0: it is along z, with so many
// layers of prisms (hexahedra with quads = 1). rim > 0: so many equal arcs around on both sides, which meet when the rotor
// turns by -1. dr, gap: faults in the rotor's radius and height.
// The hole in the ball is made of two halves: gmsh would give shapes in the same place the same mesh.
DefineConstant[h_in = 0.12, h_out = 0.36, h_far = 0.36, layers = 0, quads = 0, rim = 0, dr = 0, gap = 0];
SetFactory("OpenCASCADE");
radius = 0.6; height = 0.5;
x = 0.2; y = -0.1; z = 0.15;
ax = layers > 0 ? 0 : 1; ay = 2 * ax; az = 3 - ax; length = 3;
For half In {1 : 2}
  Cylinder(half) = {x, y, z, height * ax / length, height * ay / length, height * az / length, radius, Pi};
EndFor
Rotate { {ax, ay, az}, {x, y, z}, Pi } { Volume{2}; }
Sphere(3) = {0, 0, 0, 2};
BooleanDifference(4) = { Volume{3}; Delete; }{ Volume{1, 2}; Delete; };
MeshSize{ PointsOf{ Volume{4}; } } = h_out;
far[] = Surface In BoundingBox {-2.1, -2.1, -2.1, 2.1, 2.1, 2.1};
inside[] = Surface In BoundingBox {-1.5, -1.5, -1.5, 1.5, 1.5, 1.5};
far[] -= inside[];
MeshSize{ PointsOf{ Surface{far[]}; } } = h_far;
halves[] = Curve In BoundingBox {-1.5, -1.5, -1.5, 1.5, 1.5, 1.5};
tall = height - gap;
If (layers > 0)
  Disk(100) = {x, y, z, radius + dr};
  Rotate { {0, 0, 1}, {x, y, z}, 1 } { Surface{100}; }
  If (quads == 1)
    Recombine Surface{100};
  EndIf
  stack[] = Extrude {0, 0, tall} { Surface{100}; Layers{layers}; Recombine; };
  rotor = stack[1];
Else
  rotor = newv;
  Cylinder(rotor) = {x, y, z, tall * ax / length, tall * ay / length, tall * az / length, radius + dr};
  Rotate { {ax, ay, az}, {x, y, z}, 1 } { Volume{rotor}; }
EndIf
MeshSize{ PointsOf{ Volume{rotor}; } } = h_in;
If (rim > 0)
  own[] = Boundary{ Volume{rotor}; };
  circles[] = CombinedBoundary{ Surface{own[1]}; };
  circles[] += CombinedBoundary{ Surface{own[2]}; };
  Transfinite Curve{circles[]} = rim + 1;
  Transfinite Curve{halves[]} = rim / 2 + 1;  // half circles, and the lines between the halves
EndIf
slide[] = Boundary{ Volume{rotor}; };
Physical Volume("rotor") = {rotor};
Physical Volume("ball") = {4};
Physical Surface("far") = {far[]};
Physical Surface("slide") = {inside[], slide[]};
