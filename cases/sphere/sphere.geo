// Sphere of radius 1 at the origin in a ball of gas; tetrahedra with edges of length r/n at radius r.
SetFactory("OpenCASCADE");
DefineConstant[ n = 4, radius = 14 ];
Sphere(1) = {0, 0, 0, radius};
Sphere(2) = {0, 0, 0, 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Field[1] = MathEval;
Field[1].F = Sprintf("Sqrt(x*x + y*y + z*z)/%g", n);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm3D = 10; // fewer slivers than the default

Physical Volume("gas") = {3};
sphere[] = Surface In BoundingBox {-2, -2, -2, 2, 2, 2};
farfield[] = Boundary{ Volume{3}; };
farfield[] -= sphere[];
Physical Surface("sphere") = {sphere[]};
Physical Surface("farfield") = {farfield[]};
