// Ball "ball" of radius 1.2 around a cylinder "rotor" of radius 0.6 and height 0.5, with the same nodes on their common
// surface, "slide".
DefineConstant[h = 0.3];
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 0.5, 0.6};
Sphere(2) = {0, 0, 0, 1.2};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
MeshSize{:} = h;
slide[] = Boundary{ Volume{1}; };
all[] = Volume{:};
all[] -= {1};
far[] = CombinedBoundary{ Volume{:}; };
Physical Volume("rotor") = {1};
Physical Volume("ball") = {all[]};
Physical Surface("far") = {far[]};
Physical Surface("slide") = {slide[]};
