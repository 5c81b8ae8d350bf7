! rule: arguments of TryInt
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TryInt 1;
        TryInt;  ! -> RG311?
        TryInt 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
