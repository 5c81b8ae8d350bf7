! rule: arguments of TestDI
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldi v_signaldi;
    VAR bool r_bool;
    PROC main()
        r_bool := TestDI(v_signaldi);
        r_bool := TestDI();  ! -> RG311
        r_bool := TestDI(v_signaldi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
