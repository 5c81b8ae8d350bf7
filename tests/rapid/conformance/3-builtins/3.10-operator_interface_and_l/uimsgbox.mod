! rule: arguments of UIMsgBox
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool pb;
    VAR signaldi di;
    VAR signaldo dout;
    VAR errnum e;
    VAR num n;
    VAR btnres r;
    PROC main()
        UIMsgBox "a";
        UIMsgBox \Header:="h", "a" \MsgLine2:="b" \MsgLine3:="c" \MsgLine4:="d" \MsgLine5:="e" \Wrap \Buttons:=btnOK \Icon:=iconInfo \Image:="i" \Result:=r \MaxTime:=1 \DIBreak:=di \DIPassive \DOBreak:=dout \DOPassive \PersBoolBreak:=pb \PersBoolPassive \BreakFlag:=e \UIActiveSignal:=dout;
        UIMsgBox;  ! -> RG311?
    ENDPROC
ENDMODULE
