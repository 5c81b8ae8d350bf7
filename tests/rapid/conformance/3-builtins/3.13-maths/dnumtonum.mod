! rule: arguments of DnumToNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := DnumToNum(1);
        r_num := DnumToNum(1 \Integer);
        r_num := DnumToNum();  ! -> RG311
        r_num := DnumToNum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
