MODULE vector_operators
! source: [K §3.11, S4 overview 4-26] pos+pos, pos-pos, -pos, num*pos, pos*num, pos*pos, orient*orient
! source: [backup] pos/num: programs of a running cell with RobotWare 6
  PROC main()
    VAR pos a := [1,2,3];
    VAR pos b := [0,1,0];
    VAR orient r := [0.70710677,0,0,0.70710677];
    TPWrite ValToStr(a + b) + ValToStr(a - b) + ValToStr(-a) + ValToStr(2 * a) + ValToStr(a * 2);
    ! expect: [1,3,3][1,1,3][-1,-2,-3][2,4,6][2,4,6]
    TPWrite ValToStr(a * b) + ValToStr(a + [1,1,1]);
    ! expect: [-3,0,1][2,3,4]
    TPWrite ValToStr((a + b) / 2);
    ! expect: [0.5,1.5,1.5]
    a := a / (b.x * 0);
    ! expect: divided by 0
    r := r * r;
    TPWrite NumToStr(r.q1,3) + " " + NumToStr(r.q4,3);
    ! expect: 0.000 1.000
    TPWrite ValToStr(Twice([9, 8, 7] - [1, 2, 3]));
    ! expect: [16,12,8]
  ERROR
    TPWrite "divided by " + NumToStr(b.x,0);
    TRYNEXT;
  ENDPROC
  FUNC pos Twice(pos v)
    RETURN 2 * v;
  ENDFUNC
ENDMODULE
