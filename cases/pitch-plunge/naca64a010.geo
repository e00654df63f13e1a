// NACA 64A010 with a closed trailing edge, chord 1, in a C-mesh of hexahedra one cell thick (0.01): the mesh of
// ../naca0012 with another section. x forward, y up; leading edge at x = 0.25, trailing edge at x = -0.75.
// The section is a polynomial in the root of the distance, within 1.3e-4 of the ordinates in NACA Report 903 with the
// trailing edge closed; nose radius 0.0089.
DefineConstant[ n = 1 ];
far = 100; // distance of the far field
nose_length = 0.33; // arc from the leading edge to the crest

// t: square root of the distance behind the leading edge
Macro height
  y = 0.13375*t^1 - 0.44597*t^2 + 3.11379*t^3 - 12.32551*t^4 + 27.67511*t^5 - 35.12694*t^6 + 22.91454*t^7 - 5.93877*t^8;
Return
Macro arc_rate // arc length per t
  arc = Sqrt(4*t^2 + (0.13375 - 0.89194*t^1 + 9.34137*t^2 - 49.30204*t^3 + 138.37555*t^4 - 210.76164*t^5 + 160.40178*t^6 - 47.51016*t^7)^2);
Return

leading = newp; Point(leading) = {0.25, 0, 0};
trailing = newp; Point(trailing) = {-0.75, 0, 0};
front = newp; Point(front) = {0.25 + far, 0, 0};
rear = newp; Point(rear) = {-0.75 - far, 0, 0};
front_line = newl; Line(front_line) = {leading, front};
wake_line = newl; Line(wake_line) = {trailing, rear};
radial[] = {front_line};
streamwise[] = {wake_line};

base[] = {};
For side In {0:1}
  up = 1 - 2*side;

  // equal steps of arc length: the spacing of Transfinite Curve assumes them
  nose_points[] = {leading};
  t = 0;
  For i In {1:400}
    start = t;
    Call arc_rate;
    t = start + 0.5*nose_length/400/arc;
    Call arc_rate;
    t = start + nose_length/400/arc;
    Call height;
    p = newp; Point(p) = {0.25 - t^2, up*y, 0};
    nose_points[] += p;
  EndFor
  crest = p;
  x_crest = 0.25 - t^2;
  aft_points[] = {crest};
  For i In {1:49}
    x = x_crest - (x_crest + 0.75)*i/50;
    t = Sqrt(0.25 - x);
    Call height;
    p = newp; Point(p) = {x, up*y, 0};
    aft_points[] += p;
  EndFor
  aft_points[] += trailing;
  nose = newl; Spline(nose) = nose_points[];
  aft = newl; Spline(aft) = aft_points[];

  centre = newp; Point(centre) = {x_crest, 0, 0};
  above_crest = newp; Point(above_crest) = {x_crest, up*(far + 0.25 - x_crest), 0};
  above_trailing = newp; Point(above_trailing) = {-0.75 - 0.15*far, up*(far + 0.25 - x_crest), 0};
  above_rear = newp; Point(above_rear) = {-0.75 - far, up*(far + 0.25 - x_crest), 0};
  crest_line = newl; Line(crest_line) = {crest, above_crest};
  trailing_line = newl; Line(trailing_line) = {trailing, above_trailing};
  rear_line = newl; Line(rear_line) = {rear, above_rear};
  far_nose = newl; Circle(far_nose) = {front, centre, above_crest};
  far_aft = newl; Line(far_aft) = {above_crest, above_trailing};
  far_wake = newl; Line(far_wake) = {above_trailing, above_rear};

  loop = newll; Curve Loop(loop) = {nose, crest_line, -far_nose, -front_line};
  nose_block = news; Plane Surface(nose_block) = {loop};
  loop = newll; Curve Loop(loop) = {aft, trailing_line, -far_aft, -crest_line};
  aft_block = news; Plane Surface(aft_block) = {loop};
  loop = newll; Curve Loop(loop) = {wake_line, rear_line, -far_wake, -trailing_line};
  wake_block = news; Plane Surface(wake_block) = {loop};
  base[] += {nose_block, aft_block, wake_block};

  radial[] += {crest_line, trailing_line, rear_line};
  streamwise[] += far_wake;
  Transfinite Curve {nose} = 16*n + 1 Using Progression 1.25^(1/n);
  Transfinite Curve {far_nose} = 16*n + 1;
  Transfinite Curve {aft, far_aft} = 20*n + 1 Using Progression 0.92^(1/n);
EndFor
Transfinite Curve {radial[]} = 30*n + 1 Using Progression 1.36^(1/n);
Transfinite Curve {streamwise[]} = 21*n + 1 Using Progression 1.5^(1/n);
Transfinite Surface {base[]};
Recombine Surface {base[]};

sides[] = {base[]};
gas[] = {};
airfoil[] = {};
farfield[] = {};
For k In {0:#base[] - 1}
  out[] = Extrude {0, 0, 0.01} { Surface{base[k]}; Layers{1}; Recombine; };
  sides[] += out[0];
  gas[] += out[1];
  farfield[] += out[4];
  If (k%3 == 2)
    farfield[] += out[3];
  Else
    airfoil[] += out[2];
  EndIf
EndFor

Physical Volume("gas") = {gas[]};
Physical Surface("airfoil") = {airfoil[]};
Physical Surface("farfield") = {farfield[]};
Physical Surface("sides") = {sides[]};
