// Ball of radius 3 around a sphere of radius 0.5, tetrahedra; for tests of bodies that move.
DefineConstant[ h = 0.35 ];
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 3};
Sphere(2) = {0, 0, 0, 0.5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
sphere[] = Surface In BoundingBox {-0.6, -0.6, -0.6, 0.6, 0.6, 0.6};
far[] = Boundary{ Volume{3}; };
far[] -= sphere[];
MeshSize{ PointsOf{ Volume{3}; } } = 3*h;
MeshSize{ PointsOf{ Surface{sphere[]}; } } = h;
Physical Volume("air") = {3};
Physical Surface("sphere") = {sphere[]};
Physical Surface("far") = {far[]};
