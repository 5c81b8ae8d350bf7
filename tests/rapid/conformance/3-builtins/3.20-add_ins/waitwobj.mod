! rule: arguments of WaitWObj
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool v_bool;
    PERS wobjdata p_wobjdata;
    PROC main()
        WaitWObj p_wobjdata;
        WaitWObj p_wobjdata \RelDist:=1 \MaxTime:=1 \TimeFlag:=v_bool;
        WaitWObj;  ! -> RG311?
        WaitWObj p_wobjdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
