! rule: a call has no component
! source: [K §3]
MODULE Demo
    VAR num a;
    PROC main()
        a := CPos().x;  ! -> RG201
    ENDPROC
ENDMODULE
