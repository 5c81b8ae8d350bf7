! rule: arguments of ReadVar
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r;
    PROC main()
        r := ReadVar("x", 1);
        r := ReadVar("x", 1 \TaskName:="x");
        r := ReadVar();  ! -> RG311
        r := ReadVar("x", 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
