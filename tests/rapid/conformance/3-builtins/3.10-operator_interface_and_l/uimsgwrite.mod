! rule: arguments of UIMsgWrite
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo dout;
    VAR string a{2};
    PROC main()
        UIMsgWrite \Header:="h" \Message:="m" \Wrap \Icon:=iconInfo \Image:="i" \UIActiveSignal:=dout;
        UIMsgWrite \Message:="m" \MsgArray:=a;  ! -> RG313
    ENDPROC
ENDMODULE
