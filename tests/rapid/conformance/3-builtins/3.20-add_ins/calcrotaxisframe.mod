! rule: arguments of CalcRotAxisFrame
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num v_num;
    VAR pose r;
    VAR robtarget v_robtarget_array{2};
    PROC main()
        r := CalcRotAxisFrame(v_mecunit, v_robtarget_array, 1, v_num, v_num);
        r := CalcRotAxisFrame(v_mecunit \AxisNo:=1, v_robtarget_array, 1, v_num, v_num);
        r := CalcRotAxisFrame();  ! -> RG311
        r := CalcRotAxisFrame(v_mecunit, v_robtarget_array, 1, v_num, v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
