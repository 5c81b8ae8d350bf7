! rule: types of options are not unknown
! source: [manual] 3HAC050917
! given: system
MODULE Demo
    VAR num n;
    VAR sensorvardata d;
    VAR no_such_data e;  ! -> RG303
    PROC main()
        d.x := 1;
        n := d.x;
    ENDPROC
ENDMODULE
