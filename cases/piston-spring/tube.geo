// Tube 0 < x < length of cross-section 1 × 1, n hexahedra per unit of length, one across. The piston is at x = 0.
DefineConstant[ n = 10, length = 16 ];
Point(1) = {0, 0, 0};
line[] = Extrude {0, 1, 0} { Point{1}; Layers{1}; };
floor[] = Extrude {length, 0, 0} { Curve{line[1]}; Layers{n*length}; Recombine; };
tube[] = Extrude {0, 0, 1} { Surface{floor[1]}; Layers{1}; Recombine; };

Physical Volume("tube") = {tube[1]};
Physical Surface("piston") = {tube[2]};
Physical Surface("open") = {tube[4]};
Physical Surface("sides") = {floor[1], tube[0], tube[3], tube[5]};
