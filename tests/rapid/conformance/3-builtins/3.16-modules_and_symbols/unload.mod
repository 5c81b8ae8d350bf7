! rule: arguments of UnLoad
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        UnLoad "x";
        UnLoad \ErrIfChanged, "x" \File:="x";
        UnLoad \Save, "x" \File:="x";
        UnLoad;  ! -> RG311?
        UnLoad "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
