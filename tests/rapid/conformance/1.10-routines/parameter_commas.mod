! rule: a comma stands between required parameters, and before none
! source: [K §5.1]
MODULE Demo
    PROC leading(, num a)  ! -> RG201
    ENDPROC
    PROC missing(num a num b)  ! -> RG201
    ENDPROC
    PROC main()
    ENDPROC
ENDMODULE
