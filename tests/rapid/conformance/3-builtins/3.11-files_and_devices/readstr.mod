! rule: arguments of ReadStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR string r_string;
    PROC main()
        r_string := ReadStr(v_iodev);
        r_string := ReadStr(v_iodev \Delim:="x" \RemoveCR \DiscardHeaders \Time:=1 \Line:=1);
        r_string := ReadStr();  ! -> RG311
        r_string := ReadStr(v_iodev \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
