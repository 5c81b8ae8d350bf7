! rule: what another release brings is a note where the release is not told
! source: [code] a driver for RobotWare 5, 6 and 7 (UnpackRawBytes)
MODULE Demo
    PROC main()
        VAR rawbytes r;
        VAR string s;
        UnpackRawBytes r, 1, s \UTF8Encoding:=4;  ! -> RG325~
        UnpackRawBytes r, 1, s \ASCII:=4;
        TPWrite s;
        DebugBreak;  ! -> RG325~
    ENDPROC
ENDMODULE
