! rule: arguments of ClkRead
! source: [manual] 3HAC050917
MODULE Demo
    VAR clock v_clock;
    VAR num r_num;
    PROC main()
        r_num := ClkRead(v_clock);
        r_num := ClkRead(v_clock \HighRes);
        r_num := ClkRead();  ! -> RG311
        r_num := ClkRead(v_clock \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
