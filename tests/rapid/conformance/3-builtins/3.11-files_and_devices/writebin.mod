! rule: arguments of WriteBin
! source: [manual] 3HAC050917
MODULE Demo
    VAR iodev v_iodev;
    VAR num v_num_array{2};
    PROC main()
        WriteBin v_iodev, v_num_array, 1;
        WriteBin v_iodev, v_num_array;  ! -> RG311
        WriteBin v_iodev, v_num_array, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
