// Box "box" [-1, 1]^3 around a cylinder "rotor" of radius 0.5 and height 0.4 about z, each with a surface mesh of its own on
// it, "slide"; in the cylinder two flat blades "propeller", tilted alike. Tetrahedra, edges h.
DefineConstant[h = 0.16];
SetFactory("OpenCASCADE");
Box(10) = {-1, -1, -1, 2, 2, 2};
// The hole is made of two halves: gmsh would give shapes in the same place the same mesh.
For half In {1 : 2}
  Cylinder(half) = {0, 0, -0.2, 0, 0, 0.4, 0.5, Pi};
EndFor
Rotate { {0, 0, 1}, {0, 0, 0}, Pi } { Volume{2}; }
BooleanDifference(11) = { Volume{10}; Delete; }{ Volume{1, 2}; Delete; };
Cylinder(20) = {0, 0, -0.2, 0, 0, 0.4, 0.5};
Box(30) = {0.06, -0.09, -0.025, 0.32, 0.18, 0.05};
Rotate { {1, 0, 0}, {0, 0, 0}, 0.35 } { Volume{30}; }
Rotate { {0, 0, 1}, {0, 0, 0}, Pi } { Duplicata { Volume{30}; } }
blades[] = Volume In BoundingBox {-0.45, -0.2, -0.15, 0.45, 0.2, 0.15};
BooleanDifference(21) = { Volume{20}; Delete; }{ Volume{blades[]}; Delete; };
Rotate { {0, 0, 1}, {0, 0, 0}, 1 } { Volume{21}; }
sides[] = Boundary{ Volume{11}; };
hole[] = Surface In BoundingBox {-0.6, -0.6, -0.3, 0.6, 0.6, 0.3};
own[] = Boundary{ Volume{21}; };
blade[] = Surface In BoundingBox {-0.45, -0.45, -0.15, 0.45, 0.45, 0.15};
hole[] -= own[];
sides[] -= hole[];
own[] -= blade[];
Physical Volume("box") = {11};
Physical Volume("rotor") = {21};
Physical Surface("slide") = {hole[], own[]};
Physical Surface("sides") = {sides[]};
Physical Surface("propeller") = {blade[]};
MeshSize{:} = h;
MeshSize{ PointsOf{ Surface{blade[]}; } } = 0.5 * h;
