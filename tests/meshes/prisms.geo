// Unit square of triangles, n along each side, extruded to prisms: nz layers of thickness lz / nz.
DefineConstant[n = 6, nz = 1, lz = 0.1];
Point(1) = {0, 0, 0, 1 / n};
line[] = Extrude {1, 0, 0} { Point{1}; Layers{n}; };
Transfinite Line{line[1]} = n + 1;
Point(10) = {1, 1, 0, 1 / n};
Point(11) = {0, 1, 0, 1 / n};
Line(10) = {2, 10};
Line(11) = {10, 11};
Line(12) = {11, 1};
Curve Loop(1) = {line[1], 10, 11, 12};
Plane Surface(1) = {1};
volume[] = Extrude {0, 0, lz} { Surface{1}; Layers{nz}; Recombine; };
Physical Volume("air") = {volume[1]};
Physical Surface("symmetry") = {1, volume[0]};
Physical Surface("far") = {volume[{2:5}]};
