! rule: arguments of GetSignalOrigin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signalorigin result;
    VAR string v_string;
    PROC main()
        result := GetSignalOrigin(v_num, v_string);
        result := GetSignalOrigin();  ! -> RG311
    ENDPROC
ENDMODULE
