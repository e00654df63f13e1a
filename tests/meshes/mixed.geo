// Unit column of height 3: n x n x n hexahedra, then pyramids and tetrahedra, then n layers of prisms.
DefineConstant[n = 4];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0, 1, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
top[] = Surface In BoundingBox {-0.1, -0.1, 1.9, 1.1, 1.1, 2.1};
block[] = Boundary { Volume{1}; };
all_curves[] = Curve{:};
Transfinite Curve {all_curves[]} = n + 1;
Transfinite Surface { block[] };
Recombine Surface { block[] };
Transfinite Volume {1};
prisms[] = Extrude {0, 0, 1} { Surface{top[0]}; Layers{n}; Recombine; };
bottom[] = Surface In BoundingBox {-0.1, -0.1, -0.1, 1.1, 1.1, 0.1};
volumes[] = Volume{:};
boundary[] = CombinedBoundary { Volume{volumes[]}; };
boundary[] -= {bottom[]};
Physical Volume("air") = {volumes[]};
Physical Surface("bottom") = {bottom[]};
Physical Surface("far") = {boundary[]};
