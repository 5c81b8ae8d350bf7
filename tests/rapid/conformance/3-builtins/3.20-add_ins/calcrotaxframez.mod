! rule: arguments of CalcRotAxFrameZ
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR pose r;
    VAR robtarget v_robtarget;
    VAR robtarget v_robtarget_array{2};
    PROC main()
        r := CalcRotAxFrameZ(v_robtarget_array, 1, v_robtarget, v_num, v_num);
        r := CalcRotAxFrameZ();  ! -> RG311
        r := CalcRotAxFrameZ(v_robtarget_array, 1, v_robtarget, v_num, v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
