// Box [-3, 2] x [-2, 2] x [-0.8, 0.8] with a cylinder (radius 1, height 0.8, axis z) in its middle; tetrahedra, edges 1/n.
// slide = 1: the cylinder is a zone of its own, meshed independently of the box on the cylinder's surface.
// slide = 0: one zone, the same sizes, the cylinder's surface kept as a place for faces.
DefineConstant[ n = 6, slide = 1 ];
SetFactory("OpenCASCADE");
Box(10) = {-3, -2, -0.8, 5, 4, 1.6};
If (slide)
  // The hole is made of two halves: gmsh would give shapes in the same place the same mesh.
  For half In {1 : 2}
    Cylinder(half) = {0, 0, -0.4, 0, 0, 0.8, 1, Pi};
  EndFor
  Rotate { {0, 0, 1}, {0, 0, 0}, Pi } { Volume{2}; }
  BooleanDifference(11) = { Volume{10}; Delete; }{ Volume{1, 2}; Delete; };
  all[] = Boundary{ Volume{11}; };
  hole[] = Surface In BoundingBox {-1.1, -1.1, -0.5, 1.1, 1.1, 0.5};
  Cylinder(20) = {0, 0, -0.4, 0, 0, 0.8, 1};
  Rotate { {0, 0, 1}, {0, 0, 0}, 1 } { Volume{20}; }
  Physical Volume("box") = {11};
  Physical Volume("rotor") = {20};
  Physical Surface("box_slide") = {hole[]};
  Physical Surface("rotor_slide") = Boundary{ Volume{20}; };
  sides[] = all[];
  sides[] -= hole[];
Else
  Cylinder(1) = {0, 0, -0.4, 0, 0, 0.8, 1};
  parts[] = BooleanFragments{ Volume{10}; Delete; }{ Volume{1}; Delete; };
  Physical Volume("box") = {parts[]};
  sides[] = CombinedBoundary{ Volume{parts[]}; };
EndIf
flat[] = Surface In BoundingBox {-3.1, -2.1, -0.81, 2.1, 2.1, -0.79};
flat[] += Surface In BoundingBox {-3.1, -2.1, 0.79, 2.1, 2.1, 0.81};
sides[] -= flat[];
Physical Surface("flat") = {flat[]};
Physical Surface("sides") = {sides[]};
MeshSize{:} = 1 / n;
Mesh.Algorithm3D = 10;
