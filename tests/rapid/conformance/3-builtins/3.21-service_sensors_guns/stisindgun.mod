! rule: arguments of STIsIndGun
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := STIsIndGun(v_string);
        result := STIsIndGun();  ! -> RG311
    ENDPROC
ENDMODULE
