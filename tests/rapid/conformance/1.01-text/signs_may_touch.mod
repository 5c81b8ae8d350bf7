! rule: other tokens may touch
! source: [K §2.2]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a:=(1+2)*-3;  ! -> RG212?
        b:=a{1};  ! -> RG318
    ENDPROC
ENDMODULE
