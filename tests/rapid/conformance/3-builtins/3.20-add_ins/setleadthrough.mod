! rule: arguments of SetLeadThrough
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SetLeadThrough;
        SetLeadThrough \On \NoStopMove \NoClearPath;
        SetLeadThrough \Off \NoStartMove \NoClearPath;
        SetLeadThrough \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
