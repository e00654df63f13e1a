// Box [0, lx] x [0, ly] x [0, lz] of nx x ny x nz hexahedra; a patch on each side.
DefineConstant[nx = 6, ny = 5, nz = 4, lx = 1, ly = 1, lz = 1];
Point(1) = {0, 0, 0};
line[] = Extrude {lx, 0, 0} { Point{1}; Layers{nx}; };
area[] = Extrude {0, ly, 0} { Line{line[1]}; Layers{ny}; Recombine; };
volume[] = Extrude {0, 0, lz} { Surface{area[1]}; Layers{nz}; Recombine; };
Physical Volume("air") = {volume[1]};
Physical Surface("zmin") = {area[1]};
Physical Surface("zmax") = {volume[0]};
Physical Surface("ymin") = {volume[2]};
Physical Surface("xmax") = {volume[3]};
Physical Surface("ymax") = {volume[4]};
Physical Surface("xmin") = {volume[5]};
