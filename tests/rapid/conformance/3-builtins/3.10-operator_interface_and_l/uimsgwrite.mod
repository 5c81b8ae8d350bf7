! rule: arguments of UIMsgWrite
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo dout;
    VAR string a{2};
    PROC main()
        UIMsgWrite "h", "m" \Wrap \Icon:=iconInfo \Image:="i" \UIActiveSignal:=dout;
        UIMsgWrite "h" \MsgArray:=a;
        UIMsgWrite "h", "m" \MsgArray:=a;  ! -> RG313
        UIMsgWrite "h";  ! -> RG311
        UIMsgWrite "h", "m" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
