! rule: arguments of TPReadFK
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool pb;
    VAR signaldi di;
    VAR signaldo dout;
    VAR errnum e;
    VAR num n;
    VAR btnres r;
    PROC main()
        TPReadFK n, "t", "1", "2", "3", "4", stEmpty;
        TPReadFK n, "t", "1", "2", "3", "4", "5" \MaxTime:=1 \DIBreak:=di \DIPassive \DOBreak:=dout \DOPassive \PersBoolBreak:=pb \PersBoolPassive \BreakFlag:=e \UIActiveSignal:=dout;
        TPReadFK n, "t", "1", "2", "3", "4";  ! -> RG311
    ENDPROC
ENDMODULE
