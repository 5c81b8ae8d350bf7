! rule: functions are not bound late
! source: [K §4.5]
MODULE Demo
    VAR num a;
    FUNC num f()
        RETURN 1;
    ENDFUNC
    PROC main()
        a := %"f"%();  ! -> RG201
        a := f();
    ENDPROC
ENDMODULE
