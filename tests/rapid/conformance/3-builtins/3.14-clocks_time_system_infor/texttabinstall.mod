! rule: arguments of TextTabInstall
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TextTabInstall "x";
        TextTabInstall;  ! -> RG311?
        TextTabInstall "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
