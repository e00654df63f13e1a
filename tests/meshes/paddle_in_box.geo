// Box "box" [-1.5, 1.5] x [-0.7, 0.7] x [-0.7, 0.7] around a cylinder "rotor" of radius 0.5 and height 0.6 about z; tetrahedra,
// edges h. slide = 1: each has a surface mesh of its own on the cylinder, "slide". slide = 0: one zone, the cylinder's surface
// kept as a place for faces. paddle = 1: a flat blade "paddle" in the rotor, across its radius.
DefineConstant[h = 0.2, slide = 1, paddle = 0];
SetFactory("OpenCASCADE");
Box(10) = {-1.5, -0.7, -0.7, 3, 1.4, 1.4};
Cylinder(20) = {0, 0, -0.3, 0, 0, 0.6, 0.5};
rotor = 20;
If (paddle)
  Box(30) = {-0.35, -0.04, -0.15, 0.7, 0.08, 0.3};
  Rotate { {1, 0, 0}, {0, 0, 0}, 0.5 } { Volume{30}; }
  BooleanDifference(21) = { Volume{20}; Delete; }{ Volume{30}; Delete; };
  rotor = 21;
EndIf
If (slide)
  // The hole is made of two halves: gmsh would give shapes in the same place the same mesh.
  For half In {1 : 2}
    Cylinder(half) = {0, 0, -0.3, 0, 0, 0.6, 0.5, Pi};
  EndFor
  Rotate { {0, 0, 1}, {0, 0, 0}, Pi } { Volume{2}; }
  BooleanDifference(11) = { Volume{10}; Delete; }{ Volume{1, 2}; Delete; };
  Rotate { {0, 0, 1}, {0, 0, 0}, 1 } { Volume{rotor}; }
  sides[] = Boundary{ Volume{11}; };
  hole[] = Surface In BoundingBox {-0.6, -0.6, -0.4, 0.6, 0.6, 0.4};
  own[] = Boundary{ Volume{rotor}; };
  blade[] = Surface In BoundingBox {-0.45, -0.45, -0.25, 0.45, 0.45, 0.25};
  hole[] -= own[];
  sides[] -= hole[];
  own[] -= blade[];
  Physical Volume("box") = {11};
  Physical Volume("rotor") = {rotor};
  Physical Surface("slide") = {hole[], own[]};
  Physical Surface("sides") = {sides[]};
  If (paddle)
    Physical Surface("paddle") = {blade[]};
  EndIf
Else
  parts[] = BooleanFragments{ Volume{10}; Delete; }{ Volume{rotor}; Delete; };
  Physical Volume("box") = {parts[]};
  Physical Surface("sides") = CombinedBoundary{ Volume{parts[]}; };
EndIf
MeshSize{:} = h;
