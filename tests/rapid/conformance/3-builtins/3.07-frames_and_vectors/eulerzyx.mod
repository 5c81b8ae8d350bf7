! rule: arguments of EulerZYX
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient o;
    VAR num n;
    PROC main()
        n := EulerZYX(\X, o);
        n := EulerZYX(\Y, o);
        n := EulerZYX(\Z, o);
        n := EulerZYX(\X \Y, o);  ! -> RG313
        n := EulerZYX(\X);  ! -> RG311
    ENDPROC
ENDMODULE
