// Unit cube of tetrahedra, n edges along each side; one wall (x = 0), the rest far field.
DefineConstant[n = 6];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{:} = 1 / n;
Physical Volume("air") = {1};
Physical Surface("wall") = {1};
Physical Surface("far") = {2:6};
