! rule: arguments of TPWrite
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPWrite "x";
        TPWrite "x" \Num:=1;
        TPWrite "x" \Bool:=TRUE;
        TPWrite "x" \Pos:=[1, 2, 3];
        TPWrite "x" \Orient:=[1, 0, 0, 0];
        TPWrite "x" \Dnum:=1;
        TPWrite;  ! -> RG311?
        TPWrite "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
