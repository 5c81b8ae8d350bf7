! rule: 0x, 0o and 0b numbers
! source: [code] intellij-rapid
MODULE Demo
    VAR num a;
    PROC main()
        a := 0x1F + 0o17 + 0b101;
    ENDPROC
ENDMODULE
